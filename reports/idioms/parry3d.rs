// Stands in for parry's crate in a file of export --as rust, with the signatures of parry3d 0.26: what
// asks parry is parry.mjs beside it.
pub mod math {
    #[derive(Clone, Copy)]
    pub struct Vector {
        pub x: f32,
        pub y: f32,
        pub z: f32,
    }
    impl Vector {
        pub fn new(x: f32, y: f32, z: f32) -> Self {
            Vector { x, y, z }
        }
    }
    impl std::ops::Add for Vector {
        type Output = Vector;
        fn add(self, v: Vector) -> Vector {
            Vector::new(self.x + v.x, self.y + v.y, self.z + v.z)
        }
    }
    impl std::ops::Mul<f32> for Vector {
        type Output = Vector;
        fn mul(self, s: f32) -> Vector {
            Vector::new(self.x * s, self.y * s, self.z * s)
        }
    }
    #[derive(Clone, Copy)]
    pub struct Rotation(pub [f32; 4]);
    impl Rotation {
        pub fn from_xyzw(x: f32, y: f32, z: f32, w: f32) -> Self {
            Rotation([x, y, z, w])
        }
    }
    pub struct Pose {
        pub translation: Vector,
        pub rotation: Rotation,
    }
    impl Pose {
        pub fn from_parts(translation: Vector, rotation: Rotation) -> Self {
            Pose {
                translation,
                rotation,
            }
        }
    }
}
pub mod shape {
    use super::math::Vector;
    pub trait Shape {
        fn text(&self) -> String;
    }
    macro_rules! shape {
        ($name:ident, $new:ident, $($size:ident: $kind:ty),*; $numbers:expr) => {
            pub struct $name(Vec<f32>);
            impl $name { pub fn $new($($size: $kind),*) -> Self { $name($numbers.to_vec()) } }
            impl Shape for $name {
                fn text(&self) -> String { format!("[\"{}\", {:?}]", stringify!($name), self.0) }
            }
        };
    }
    shape!(Ball, new, radius: f32; [radius]);
    shape!(Capsule, new_y, half_height: f32, radius: f32; [half_height, radius]);
    shape!(Cylinder, new, half_height: f32, radius: f32; [half_height, radius]);
    shape!(Cuboid, new, half: Vector; [half.x, half.y, half.z]);
    shape!(HalfSpace, new, normal: Vector; [normal.x, normal.y, normal.z]);
}
pub mod query {
    use super::{math::*, shape::Shape};
    #[derive(Debug)]
    pub struct Unsupported;
    pub struct Contact {
        pub point1: Vector,
        pub point2: Vector,
        pub normal1: Vector,
        pub normal2: Vector,
        pub dist: f32,
    }
    impl Contact {
        pub fn flipped(self) -> Self {
            Contact {
                point1: self.point2,
                point2: self.point1,
                normal1: self.normal2,
                normal2: self.normal1,
                ..self
            }
        }
    }
    pub fn contact(
        pos1: &Pose,
        g1: &dyn Shape,
        pos2: &Pose,
        g2: &dyn Shape,
        prediction: f32,
    ) -> Result<Option<Contact>, Unsupported> {
        let body = |p: &Pose, g: &dyn Shape| {
            let t = p.translation;
            format!("[{}, {:?}, {:?}]", g.text(), [t.x, t.y, t.z], p.rotation.0)
        };
        let asked = format!("[{}, {}, {:?}]", body(pos1, g1), body(pos2, g2), prediction);
        let answer = std::process::Command::new("node")
            .args(["parry.mjs", &asked])
            .output()
            .unwrap();
        let found: Vec<f32> = String::from_utf8(answer.stdout)
            .unwrap()
            .split_whitespace()
            .map(|word| word.parse().unwrap())
            .collect();
        assert!(answer.status.success());
        let vector = |i: usize| Vector::new(found[i], found[i + 1], found[i + 2]);
        Ok((!found.is_empty()).then(|| Contact {
            point1: vector(1),
            point2: vector(4),
            normal1: vector(7),
            normal2: vector(10),
            dist: found[0],
        }))
    }
}
