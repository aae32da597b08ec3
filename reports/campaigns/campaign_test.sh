#!/usr/bin/env bash
# One campaign however it is split, killed, starved of disk or put at the wrong time gives the same
# result to the last byte: campaign_test.sh PROGRAM.
set -u
program=$(readlink -f "$1")
folder=$(mktemp -d)
failures=0
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
RANDOM=1

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# Two cheap pose classes, in 22 units, eleven runs; three candidates, one of them with failures.
settings=(campaign --pair cylinder-sphere --class general-deep,cap
  --candidates reference,bullet,capsule)
campaign() { "$program" "${settings[@]}" --count 5500 "$@"; }
# The same for as long as it is let, whatever the machine's load.
endless() { "$program" "${settings[@]}" --count 1e9 --checkpoint 0.1 "$@"; }

# same FOLDER WHAT: its result is the one of a single process.
same() { cmp -s whole/campaign.json "$1/campaign.json" || fail "another result: $2"; }

# await COMMAND…: until that is so, however long it takes, as long as the victim runs.
await() {
  until "$@" 2>/dev/null; do
    kill -0 "$victim" 2>/dev/null || { fail "it has ended before: $*"; return; }
    sleep 0.05
  done
}
begins_with_done() { grep -q '"done":\[\[0,' "$1/shard-1-of-1.bin"; }

# refused PATTERN COMMAND…: exit code 2, with the pattern in what is printed.
refused() {
  local pattern=$1 printed
  shift
  printed=$("$@" 2>&1)
  local code=$?
  { [ "$code" -eq 2 ] && grep -q -e "$pattern" <<<"$printed"; } ||
    fail "$*: exit code $code without \"$pattern\": $(head -n 3 <<<"$printed")"
}

campaign --workers 1 --out whole >table 2>/dev/null || fail "one process"
grep -q '^bullet: ' table || fail "no table is printed"
"$program" replay "$(grep -o '"id":"[^"]*"' whole/campaign.json | head -n 1 | cut -d '"' -f 4)" \
  --candidates bullet >/dev/null || fail "a worst case cannot be replayed"

campaign --workers 2 --out two >/dev/null 2>&1
same two "two workers"

# Ten times as many configurations take no more memory, in whichever process takes most.
python3 - "$program" "${settings[@]}" <<'END' || fail "memory grows with the count"
import resource, subprocess, sys
def peak(count):
    subprocess.run([*sys.argv[1:], "--count", count, "--out", "memory" + count], check=True,
                   capture_output=True)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss  # KiB, of the largest so far
few, many = peak("1000"), peak("10000")
sys.exit(many > few + 2048)
END

export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
for ranks in 2 5; do
  mpirun --oversubscribe -n "$ranks" "$program" "${settings[@]}" --count 5500 --out "mpi$ranks" \
    >/dev/null 2>mpi.log ||
    fail "mpirun -n $ranks: $(head -n 5 mpi.log)"
  same "mpi$ranks" "mpirun -n $ranks"
done

for shard in $(shuf -i 1-7 --random-source="$program"); do
  campaign --workers 1 --shard "$shard/7" --out seven >/dev/null 2>&1 || fail "shard $shard/7"
done
"$program" campaign --merge $(ls seven/shard-*.bin | shuf --random-source="$program") --out seven-merged \
  >/dev/null || fail "merge"
same seven-merged "seven shards in random order"
cmp -s whole/shard-1-of-1.bin seven-merged/shard-1-of-1.bin || fail "another merged shard file"

# Runs of many classes, the last one short: split among shards and ranks, and killed.
few() { "$program" campaign --group everyday --candidates reference,bullet --count 12 "$@"; }
few --out few >/dev/null 2>&1 || fail "few configurations of many classes"
for shard in 1 2 3; do
  few --workers 2 --shard "$shard/3" --out few3 >/dev/null 2>&1 || fail "shard $shard/3 of few"
done
"$program" campaign --merge few3 --out few3-merged >/dev/null || fail "merge of few"
cmp -s few/campaign.json few3-merged/campaign.json || fail "another result: few in three shards"
mpirun --oversubscribe -n 2 "$program" campaign --group everyday --candidates reference,bullet \
  --count 12 --out few-mpi >/dev/null 2>&1 || fail "mpirun of few"
cmp -s few/campaign.json few-mpi/campaign.json || fail "another result: few in two ranks"
for pause in 0.1 0.2 0.3; do
  "$program" campaign --group everyday --candidates reference,bullet --count 12 --out few-killed \
    --workers 1 --checkpoint 0.01 --resume >/dev/null 2>&1 &
  sleep "$pause"
  kill -KILL $! 2>/dev/null
  wait $! 2>/dev/null
done
few --out few-killed --resume >/dev/null 2>&1
cmp -s few/campaign.json few-killed/campaign.json || fail "another result: few, killed"

# Merging refuses what does not belong together; what is missing may be run later.
mkdir empty
refused 'both hold' "$program" campaign --merge seven whole --out none
refused 'are missing' "$program" campaign --merge seven/shard-[1-5]*.bin --out none
refused 'seed is 1, not 2' campaign --seed 2 --out whole --resume
refused 'cut in another way' campaign --shard 1/3 --out seven
refused 'already holds a campaign' campaign --out whole
refused 'already holds a campaign' "$program" campaign --merge seven --out whole
refused 'cut in another way' "$program" campaign --merge seven --out seven
mkdir renamed
cp seven/shard-1-of-7.bin renamed/shard-2-of-7.bin
refused 'shard-2-of-7.bin" is shard 1/7' campaign --shard 2/7 --out renamed --resume
refused 'must hold shard files' "$program" campaign --merge empty --out none
refused 'damaged, cut short, or something else' "$program" campaign --merge mpi.log --out none
refused '--shard' campaign --shard 8/7 --out none
refused '--checkpoint' campaign --checkpoint 0 --out none
"$program" campaign --merge seven/shard-[1-5]*.bin --partial --out partial >/dev/null || fail "merge --partial"
grep -q '"complete": false' partial/campaign.json || fail "a partial result is not marked"
campaign --out partial --resume >/dev/null 2>&1
same partial "a partial merge that was finished"

# Killed eight times at random moments, with the checkpoints of a tenth of a second.
for _ in $(seq 8); do
  "$program" "${settings[@]}" --count 5500 --out killed --resume --checkpoint 0.1 >/dev/null 2>&1 &
  victim=$!
  sleep "0.$((RANDOM % 35 + 10))"
  kill -KILL "$victim" 2>/dev/null
  wait "$victim" 2>/dev/null
done
campaign --out killed --resume >/dev/null 2>&1
same killed "killed eight times"

# Stopped in order, and a second campaign at the same place meanwhile.
"$program" "${settings[@]}" --count 1e9 --checkpoint 0.1 --out 'stopped here' >stop.log 2>&1 &
victim=$!
await begins_with_done 'stopped here'
refused 'no other campaign' endless --out 'stopped here' --resume
kill -TERM "$victim"
wait "$victim"
code=$?
[ "$code" -eq 143 ] || fail "exit code $code after SIGTERM"
grep -q "^  .* --out 'stopped here' --resume$" stop.log || fail "it does not say how to go on: $(cat stop.log)"

# A checkpoint that was cut short is refused, and so is one with a changed byte.
cp -r 'stopped here' cut
truncate -s -20 cut/shard-1-of-1.bin
refused 'damaged, cut short' endless --out cut --resume
cp 'stopped here/shard-1-of-1.bin' cut/
printf X | dd of=cut/shard-1-of-1.bin bs=1 seek=2000 conv=notrunc 2>/dev/null
refused 'damaged, cut short' endless --out cut --resume

# A full disk: an error, the last checkpoint intact, and on with it once there is room.
campaign --workers 1 --shard 1/2 --out full >/dev/null 2>&1 || fail "no room for one shard"
cp full/shard-1-of-2.bin kept
ln -s /dev/full full/shard-1-of-2.bin.partial
refused 'No space left' campaign --shard 1/2 --out full --resume
cmp -s kept full/shard-1-of-2.bin || fail "a full disk has damaged the checkpoint"
[ ! -L full/shard-1-of-2.bin.partial ] || fail "a full disk leaves half a file"
campaign --shard 1/2 --out full --resume >/dev/null 2>&1 || fail "no way on after a full disk"

# The clock of the wall goes back ten years meanwhile: checkpoints go on, and so does the rest.
echo '+0' >clock
jumping=$(faketime -m now printenv LD_PRELOAD) || fail "the clock's jump needs faketime"
LD_PRELOAD=$jumping FAKETIME_DONT_FAKE_MONOTONIC=1 FAKETIME_NO_CACHE=1 \
  FAKETIME_TIMESTAMP_FILE=$folder/clock \
  "$program" "${settings[@]}" --count 1e9 --checkpoint 0.1 --out jump >/dev/null 2>&1 &
victim=$!
await begins_with_done jump
echo '-10y' >clock
before=$(head -n 1 jump/shard-1-of-1.bin)
there_is_another() { [ "$(head -n 1 jump/shard-1-of-1.bin)" != "$before" ]; }
await there_is_another
kill -KILL "$victim"
wait "$victim" 2>/dev/null

exit "$failures"
