#!/usr/bin/env bash
# Campaigns and their merging, as far as they are a matter of the command line: reports/campaigns/campaign_test.sh
# is about their results.
# shellcheck disable=SC2086 # pair and class
. "$(dirname "$0")/prelude.sh"

expect 2 '--count' campaign --count 1.5e0 --out "$folder/c"
expect 2 '--shard.*3/7' campaign --shard 8/7 --out "$folder/c"
expect 0 '^1 pose class × 1 = 1 configuration, 1 candidate; ' campaign $lying --count 1 --candidates reference \
  --out "$folder/one"
expect 0 '^4 configurations' campaign --pair cylinder-sphere --class cap,side --count 2e0 --candidates reference \
  --out "$folder/c"
expect 2 'already holds a campaign, in shard-.*bin: ./touchstone campaign .*--class cap,side.*choose another folder' \
  campaign --out "$folder/c"
expect 2 'already holds a campaign, in shard-.*choose another folder' campaign --merge "$folder/c" --out "$folder/c"
expect 0 '^4 configurations' campaign --merge "$folder/c" --out "$folder/m"
expect 2 'could not be opened' campaign --merge "$folder/none" --out "$folder/n"
expect 2 'campaign.json" is the result of a campaign: must be a shard file' campaign --merge "$folder/m/campaign.json" \
  --out "$folder/n"

# A campaign is scored, or its parts are merged.
expect 2 '^error: --count is given with --merge: must stand without it' campaign --merge "$folder/c" --count 3
expect 2 '^error: --partial is given: must stand beside --merge' campaign --partial --out "$folder/n"
expect 2 '^error: --merge is given no value: must be followed by PATH: ' campaign --merge

finish
