# SPDX-License-Identifier: MIT
# Sourced by the scripts that make pictures for pages, with `root`, `out` and usage() of their own: reads their options
# into `program`, `out` and `names`, and goes to the root, so that pictures name their scene as scenes/NAME.toml.
program=""
names=()
while (($#)); do
  case $1 in
    -h | --help) usage; exit 0 ;;
    --program) program="$(realpath -- "${2:?--program needs a file}")"; shift ;;
    -o) out="$(realpath -m -- "${2:?-o needs a folder}")"; shift ;;
    -*) usage >&2; exit 2 ;;
    *) names+=("$1") ;;
  esac
  shift
done

if [[ -z $program ]]; then
  program="$root/build/release/viewer/sidelight"
  [[ -x $program ]] || program="$root/build/demo/viewer/sidelight"
  [[ -x $program ]] || { echo "no program yet: run viewer/demo.sh first" >&2; exit 1; }
fi
cd -- "$root"
