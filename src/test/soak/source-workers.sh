#!/usr/bin/env bash
# Adds, kills, removes and brings back workers of the NGSI source under load; nothing is lost, and what stays on a disk is shown.
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
Runs the NGSI source with tasks.max=3 and its own subscriptions on a group of distributed Connect workers, each a process with a
journal folder and an address of its own, beside a Kafka broker and a stand-in for the context broker. Entities change all the
time, each change with a number. In each round a third worker joins and is stopped in order, one is killed (kill -9) and
started again, and one is killed while its journals hold records and removed: another comes in its place, and later one with its
disk. Every change that a listener answered 2xx must be on data.raw, once with exactly-once delivery; the newest state of each
entity there must be that of the context broker; and what the workers show to be on a disk must be what comes from it later.
Needs some 2.5 GB of memory.

  --rounds N            0 for the removed worker only. Default: $rounds.
  --rate N              Changes of 1 kB per second. Default: $rate.
  --exactly-once MODE   on, off or both. Default: $exactly_once.
  --plant FAULT         Shows that the checks fail: lose (a notification is answered and goes nowhere), repeat (one goes to the
                        listener twice), take-journal (the journals of a removed worker are deleted). Default: $plant.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --rounds) rounds=${2-} ;;
        --rate) rate=${2-} ;;
        --exactly-once) exactly_once=${2-} ;;
        --plant) plant=${2-} ;;
        *) fail "source-workers knows no option $1. See: ./furrow soak source-workers --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak source-workers --help"
    shift 2
done
[[ $rounds =~ ^[0-9]{1,4}$ ]] || fail "--rounds must be a whole number from 0, not '$rounds'."
[[ $rate =~ ^[1-9][0-9]{0,4}$ ]] || fail "--rate must be a whole number from 1, not '$rate'."
case $exactly_once in
    on) modes=(true) ;;
    off) modes=(false) ;;
    both) modes=(true false) ;;
    *) fail "--exactly-once must be on, off or both, not '$exactly_once'." ;;
esac
case $plant in
    none | lose | repeat | take-journal) ;;
    *) fail "--plant must be none, lose, repeat or take-journal, not '$plant'." ;;
esac

prepare_source source-workers
for mode in "${modes[@]}"; do
    run_source SourceWorkers "$run/$mode" "$rounds" "$rate" "$mode" "$plant" || fail "What was answered and what there is differ, as said above."
done
echo "source-workers: passed"
