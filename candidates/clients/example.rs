//! A cylinder against planes and spheres in Rust, over the C interface of candidates/candidate.h.
//!
//! Needs Rust 1.63.
//!
//! rustc --edition 2021 -O --crate-type cdylib candidates/clients/example.rs -o my_engine.so
//! touchstone --load ./my_engine.so report --pair cylinder-plane
use std::ffi::{c_char, c_double, c_int, c_void};

#[repr(C)] #[derive(Clone, Copy)] pub struct Shape { // 0 cylinder, 1 plane, 2 sphere; the others are of convex bodies
    kind: c_int, size: [c_double; 4], vertices: *const c_double, faces: *const c_int, vertex_count: c_int, face_count: c_int,
    rounding: c_double,
}
#[repr(C)] pub struct Pose { position: [c_double; 3], orientation: [c_double; 4] } // unit quaternion w, x, y, z
#[repr(C)] #[derive(Clone, Copy)] pub struct Point { position: [c_double; 3], normal: [c_double; 3], depth: c_double }
#[repr(C)] pub struct Answer { status: c_int, normal: [c_double; 3], signed_distance: c_double, point_count: c_int, points: [Point; 16] }
#[repr(C)] pub struct Parameter { meaning: *const c_char, min: c_double, max: c_double, usual: c_double, whole: c_int, bare: c_int }
pub struct Prepared { a: Shape, b: Shape, threshold: f64 }
#[repr(C)] pub struct Candidate {
    name: *const c_char, version: *const c_char, settings: *const c_char, models: *const c_char, parameter: *const Parameter,
    supports: extern "C" fn(*mut c_void, c_int) -> c_int,
    prepare: extern "C" fn(*mut c_void, &Shape, &Shape, c_double, c_double) -> Option<Box<Prepared>>,
    query: extern "C" fn(&Prepared, &Pose, &Pose, Option<&[c_double; 3]>, &mut Answer),
    release: extern "C" fn(Option<Box<Prepared>>),
    model_distance: Option<extern "C" fn(&Prepared, &Pose, &Pose) -> c_double>, context: *mut c_void,
}
#[repr(C)] pub struct Plugin { interface_version: c_int, count: c_int, candidates: *const Candidate, after_fork: Option<extern "C" fn()>, unforked: c_int,
    roundings: Option<extern "C" fn(&Prepared, &mut c_double, &mut c_double)> }
unsafe impl Sync for Candidate {}
unsafe impl Sync for Plugin {}

type Vector = [f64; 3];
fn add(u: Vector, v: Vector, scale: f64) -> Vector { std::array::from_fn(|i| u[i] + scale * v[i]) }
fn dot(u: Vector, v: Vector) -> f64 { u[0] * v[0] + u[1] * v[1] + u[2] * v[2] }
fn cross(u: Vector, v: Vector) -> Vector { std::array::from_fn(|i| u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]) }
fn rotate([w, x, y, z]: [f64; 4], v: Vector) -> Vector {
    let twice = add([0.0; 3], cross([x, y, z], v), 2.0); // v + 2 w (q × v) + 2 q × (q × v)
    add(add(v, twice, w), cross([x, y, z], twice), 1.0)
}

extern "C" fn supports(_: *mut c_void, other: c_int) -> c_int { (other == 1 || other == 2) as c_int }
extern "C" fn prepare(_: *mut c_void, a: &Shape, b: &Shape, threshold: c_double, _: c_double) -> Option<Box<Prepared>> {
    (supports(std::ptr::null_mut(), b.kind) != 0).then(|| Box::new(Prepared { a: *a, b: *b, threshold }))
}
extern "C" fn release(_: Option<Box<Prepared>>) {}
extern "C" fn query(pair: &Prepared, a: &Pose, b: &Pose, _: Option<&[c_double; 3]>, answer: &mut Answer) {
    let ([radius, half_length, ..], axis) = (pair.a.size, rotate(a.orientation, [0.0, 0.0, 1.0]));
    answer.point_count = 0;
    let mut report = |normal: Vector, on_a: Vector, distance: f64| {
        if distance > pair.threshold { return; }
        answer.points[answer.point_count as usize] = Point { position: add(on_a, normal, -distance / 2.0), normal, depth: -distance };
        if answer.point_count == 0 || distance < answer.signed_distance { answer.signed_distance = distance; }
        (answer.normal, answer.point_count) = (normal, answer.point_count + 1);
    };
    if pair.b.kind == 1 {
        let n = rotate(b.orientation, [pair.b.size[0], pair.b.size[1], pair.b.size[2]]);
        let mut down = add(add([0.0; 3], n, -1.0), axis, dot(n, axis)); // lies across the axis
        if dot(down, down) < 1e-24 { down = rotate(a.orientation, [1.0, 0.0, 0.0]); } // standing: any way
        for (along, across) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] { // lowest and highest point of each rim
            let on_a = add(add(a.position, axis, along * half_length), down, across * radius / dot(down, down).sqrt());
            report(n, on_a, dot(n, add(on_a, b.position, -1.0)) - pair.b.size[3]);
        }
    } else {
        let c = add(b.position, a.position, -1.0);
        let (z, radial) = (dot(c, axis), add(c, axis, -dot(c, axis)));
        let across = dot(radial, radial).sqrt();
        let outward = if across > 0.0 { add([0.0; 3], radial, 1.0 / across) } else { rotate(a.orientation, [1.0, 0.0, 0.0]) };
        let (u, v) = (across - radius, z.abs() - half_length); // beyond the side, beyond the cap
        let length = if u > 0.0 && v > 0.0 { u.hypot(v) } else { u.max(v) };
        let (side, cap) = if u > 0.0 && v > 0.0 { (u / length, v / length) } else if u > v { (1.0, 0.0) } else { (0.0, 1.0) };
        let n = add(add([0.0; 3], outward, -side), axis, -cap * 1f64.copysign(z)); // from the sphere to the cylinder
        report(n, add(b.position, n, length), length - pair.b.size[0]);
    }
    answer.status = (answer.point_count == 0) as c_int; // contact or none
}

static CANDIDATE: Candidate = Candidate {
    name: b"example-rust\0".as_ptr().cast(), version: b"1.0\0".as_ptr().cast(), settings: b"closed form, double precision; points halfway between the bodies\0".as_ptr().cast(),
    models: std::ptr::null(), parameter: std::ptr::null(), supports, prepare, query, release, model_distance: None, context: std::ptr::null_mut(),
};
static PLUGIN: Plugin = Plugin { interface_version: 5, count: 1, candidates: &CANDIDATE, after_fork: None, unforked: 0, roundings: None };
#[no_mangle] pub extern "C" fn touchstone_plugin() -> *const Plugin { &PLUGIN }
