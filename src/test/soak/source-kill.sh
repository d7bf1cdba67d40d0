#!/usr/bin/env bash
# Kills the worker of the NGSI source under load, again and again; what was answered must be in Kafka.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/source.sh
. "$soak/parts/source.sh"

rounds=20
rate=1000
exactly_once=both
seed=$RANDOM

usage() {
    cat <<USAGE
Usage: ./furrow soak source-kill [OPTION VALUE]…
Runs the NGSI source in a distributed Connect worker beside a Kafka broker, both started for this. In each round notifications
come in and kill -9 ends the worker at a random moment; it is started again, and everything that was answered 200 must be
on data.raw: once with exactly-once delivery, else at least once with the same ce_id.

  --rounds N            Default: $rounds.
  --rate N              Notifications of 1 kB per second. Default: $rate.
  --exactly-once MODE   on, off or both. Default: $exactly_once.
  --seed N              Of the random moments. Default: another each time; it is printed.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --rounds) rounds=${2-} ;;
        --rate) rate=${2-} ;;
        --exactly-once) exactly_once=${2-} ;;
        --seed) seed=${2-} ;;
        *) fail "source-kill knows no option $1. See: ./furrow soak source-kill --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak source-kill --help"
    shift 2
done
[[ $rounds =~ ^[1-9][0-9]*$ ]] || fail "--rounds must be a whole number from 1, not '$rounds'."
[[ $rate =~ ^[1-9][0-9]*$ ]] || fail "--rate must be a whole number from 1, not '$rate'."
[[ $seed =~ ^[0-9]+$ ]] || fail "--seed must be a whole number, not '$seed'."
case $exactly_once in
    on) modes=(true) ;;
    off) modes=(false) ;;
    both) modes=(true false) ;;
    *) fail "--exactly-once must be on, off or both, not '$exactly_once'." ;;
esac

prepare_source source-kill
for mode in "${modes[@]}"; do
    run_source SourceKill "$run/$mode" "$rounds" "$rate" "$mode" "$seed" || fail "Something that was answered is missing, or there twice."
done
echo "source-kill: passed"
