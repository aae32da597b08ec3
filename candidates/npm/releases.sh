# shellcheck shell=bash
# The releases of engines from npm, for ./touchstone: which are named, and how they are installed.

# The engines from npm that a list of candidates in the arguments names, one a line.
named_npm_engines() {
  printf '%s\n' "$@" | sed 's/[,=]/\n/g' |
    grep -xE '(jolt|rapier|physx|havok|mujoco3)[-a-z0-9]*(:[-.0-9e]*)?(@[-+.0-9A-Za-z]*)?' | sort -u || true
}

npm_package() {
  case $1 in
    jolt*) echo jolt-physics ;;
    rapier*) echo @dimforge/rapier3d-compat ;;
    physx*) echo physx-js-webidl ;;
    havok*) echo @babylonjs/havok ;;
    mujoco3*) echo @mujoco/mujoco ;;
  esac
}

# The releases of a package, in order; none where npm cannot be asked.
npm_releases() {
  npm view "$1" versions --json 2>/dev/null | grep -o '"[^"]*"' | tr -d '"' | sort -V || true
}

# The candidates of "--history ENGINE" where --candidates names none: the newest ten of the minor
# versions, of each the newest release. Those of Rapier are three years'.
history_releases() {
  local engine='' last='' argument package
  for argument in "$@"; do
    case $argument in
      --candidates | --candidates=*) return ;;
      --history=*) engine=${argument#*=} ;;
    esac
    [ "$last" = --history ] && engine=$argument
    last=$argument
  done
  package=$(npm_package "$engine")
  [ -z "$package" ] && return
  npm_releases "$package" | grep -xE '[0-9]+[.][0-9]+[.][0-9]+' | cut -d . -f 1,2 | uniq |
    tail -n 10 | sed "s/^/$engine@/" | paste -s -d , || true
}

# Installs the newest release that begins as the name says, "rapier@0.14", in FOLDER/PACKAGE@0.14.1,
# and calls it PACKAGE@0.14, too. Where npm cannot be asked, what was installed before has to do.
# Fails on a release that does not exist, with the nearest.
install_release() {
  local wanted=${1#*@} to=$2 package releases newest
  package=$(npm_package "$1")
  [[ $wanted == *.*.* && -d $to/$package@$wanted ]] && return
  releases=$(npm_releases "$package")
  [ -z "$releases" ] && return
  newest=$(awk -v wanted="$wanted" \
    '$0 == wanted || (index($0, wanted ".") == 1 && !/-/)' <<<"$releases" | tail -n 1)
  if [ -z "$newest" ]; then
    local near
    near=$(printf '%s\n' "$wanted" "$releases" | grep -v -- - | sort -V | grep -xF -C 2 -- "$wanted" |
      grep -vxF -- "$wanted" | paste -s -d ,)
    printf 'error: the engine is "%s": must be a release of %s; the nearest are %s\n' \
      "$1" "$package" "${near//,/, }" >&2
    return 2
  fi
  local folder=$to/$package@$newest
  if [ ! -d "$folder" ]; then
    say "installing $package $newest from npm"
    mkdir -p "$folder.new"
    if ! npm install --ignore-scripts --no-audit --no-fund --prefix "$folder.new" \
      "$package@$newest" >"$to/install.log" 2>&1; then
      tail -n 5 "$to/install.log" >&2
      say "it could not be installed; all of it is in $to/install.log"
      return 2
    fi
    mv "$folder.new" "$folder"
  fi
  [ "$newest" = "$wanted" ] || ln -sfn "${folder##*/}" "$to/$package@$wanted"
}
