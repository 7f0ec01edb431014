#!/bin/bash
# The add-on as Blender installs it: Edit > Preferences > Add-ons > Install.   usage: bindings/blender/make_zip.sh FILE.zip
set -euo pipefail
(( $# == 1 )) || { sed -n '2s/^# //p' "$0" >&2; exit 2; }
file=$(realpath -m "$1")
cd "$(dirname "$0")"
rm -f "$file"
/usr/bin/python3 - "$file" <<'END'
import pathlib, sys, zipfile

with zipfile.ZipFile(sys.argv[1], "w", zipfile.ZIP_DEFLATED) as file:
    for path in sorted(pathlib.Path("tact_blender").glob("*.py")):
        entry = zipfile.ZipInfo(path.as_posix())  # without a time: the same files give the same bytes
        entry.compress_type = zipfile.ZIP_DEFLATED
        file.writestr(entry, path.read_bytes())
END
echo "$file"
