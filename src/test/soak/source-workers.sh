#!/usr/bin/env bash
# Adds, kills, removes and restores workers of the NGSI source under load; no notification is lost, and records left on a disk are reported.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/source.sh
. "$soak/parts/source.sh"

rounds=3
rate=200
exactly_once=both
plant=none

usage() {
    cat <<USAGE
Usage: ./furrow soak source-workers [OPTION VALUE]…
Starts a Kafka broker, a stand-in for the context broker and a group of distributed Connect workers, each a process with its own journal
folder and address. The NGSI source runs there with tasks.max=3 and its own subscriptions. Entities change continuously, and each change
has a number. In each round a third worker joins and is stopped, one worker is killed (kill -9) and restarted, and one is killed while its
journals have records, and removed: another worker replaces it, and later one with its disk. Every change that a listener answered 2xx
must be on data.raw, once with exactly-once delivery. The newest state of each entity there must equal that of the context broker. The
records that the workers report as left on a disk must be those that are read from it later.
Needs some 2.5 GB of memory.

  --rounds N            Rounds; 0 tests only the removed worker. Default: $rounds.
  --rate N              Changes of 1 kB per second. Default: $rate.
  --exactly-once MODE   on, off or both. Default: $exactly_once.
  --plant FAULT         Plants a fault that the checks must find: lose (a notification is answered and dropped), repeat (one is sent to
                        the listener twice), take-journal (the journals of a removed worker are deleted). Default: $plant.
USAGE
}

read_options "rounds rate exactly-once plant" "$@"
check_numbers 0 rounds
check_numbers 1 rate
check_choice exactly-once on off both
case $exactly_once in on) modes=true ;; off) modes=false ;; *) modes="true false" ;; esac
check_choice plant none lose repeat take-journal

prepare_source
for mode in $modes; do
    run_program source.SourceWorkers "$run/$mode" "$rounds" "$rate" "$mode" "$plant" || fail "The differences are listed above."
done
echo "source-workers: passed"
