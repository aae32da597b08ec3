#!/usr/bin/env bash
# Tiny steps and slow motions.
. "$(dirname "$0")/prelude.sh"

expect 2 '--part.*amplification, maps, sequences' stability --part nothing --out "$folder/s"
expect 2 '--count' stability --count 0
expect 2 '--class' stability --class nowhere
expect 2 '--part' stability $rim --part maps
expect 2 'leaves no choice' stability $rim --pair cylinder-box
expect 2 'identity.class' stability cylinder-box/none/1/2
expect 0 'depth x' stability cylinder-plane/standing/1/0 --candidates reference,ode --count 2 --out "$folder/s"
[ -s "$folder/s/stability.html" ] || failed "no stability.html"

# In place of a table without rows it says why there are none.
expect 0 '^Small steps: nothing was measured, for no candidate has a routine for such a$' \
  stability cylinder-plane/standing/1/0 --candidates libccd-gjk --count 1 --out "$folder/s"
expect 0 '^Maps: nothing was measured, for there is none of such a pair' \
  stability --pair cylinder-sphere --part maps --candidates reference --out "$folder/s"

finish
