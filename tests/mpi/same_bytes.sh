#!/bin/bash
# Does `tact-mpi pile` write the same bytes on any number of ranks?   usage: same_bytes.sh TACT_MPI SIZE FRAMES RANKS...
set -euo pipefail
program=$1 size=$2 frames=$3
shift 3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# The ranks share the cores of this machine, which may have fewer of them.
export ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0  # Open MPI keeps what it allocates
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMP_NUM_THREADS=1 OMPI_MCA_mpi_yield_when_idle=1
first=
for ranks in "$@"; do
  file=$folder/$ranks.jsonl
  # Shared out anew nearly every step, so that bodies change hands.
  mpirun --oversubscribe -n "$ranks" "$program" pile --size "$size" --frames "$frames" --rebalance 1.01 \
    --out "$file" --json "$folder/$ranks.json" > "$folder/$ranks.txt"
  if [[ -z $first ]]; then
    first=$file
    grep -q '"pairs":\[' "$file" && grep -q '"positions":\[' "$file"
  fi
  cmp "$first" "$file" || { echo "other bytes on $ranks ranks"; exit 1; }
  echo "$ranks ranks: $(sha256sum < "$file" | cut -c 1-16), $(wc -c < "$file") bytes"
done

# A link leads to its file as before, and a pipe stays one.
ln -s target.jsonl "$folder/link"
mkfifo "$folder/pipe"
mpirun --oversubscribe -n 2 "$program" pile --size 4 --frames 2 --out "$folder/link" > "$folder/link.txt"
[[ -L $folder/link && -s $folder/target.jsonl ]] || { echo "a link was written over"; exit 1; }
if mpirun --oversubscribe -n 2 "$program" pile --size 4 --frames 2 --out "$folder/pipe" > "$folder/pipe.txt" 2>&1; then
  echo "a pipe was taken"
  exit 1
fi
[[ -p $folder/pipe ]] && grep -q 'no file' "$folder/pipe.txt" || { echo "a pipe was written over"; exit 1; }
