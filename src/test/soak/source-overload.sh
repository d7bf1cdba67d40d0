#!/usr/bin/env bash
# Presses on an NGSI source whose journal is full and shows that its memory stays flat.
set -euo pipefail

soak=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
home=$(cd "$soak/../../.." && pwd)
java=${JAVA_HOME:+$JAVA_HOME/bin/}java
# shellcheck source=parts/machine.sh
. "$soak/parts/machine.sh"
# shellcheck source=parts/connector.sh
. "$soak/parts/connector.sh"

seconds=120
senders=400
bytes=1000000
heap=96

usage() {
    cat <<USAGE
Usage: ./furrow soak source-overload [OPTION VALUE]…
A source with a journal of 64 MiB that nobody empties; senders press with all they have, each its own connection. Its resident
memory is shown every ten seconds; at the end it must not be 64 MiB above that of the first quarter.

  --seconds N  How long they press, at least 40. Default: $seconds.
  --senders N  Connections at a time. Default: $senders.
  --bytes N    Of a notification. Default: $bytes.
  --heap N     MiB of heap of the source. Default: $heap.
USAGE
}

while (($# > 0)); do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --seconds) seconds=${2-} ;;
        --senders) senders=${2-} ;;
        --bytes) bytes=${2-} ;;
        --heap) heap=${2-} ;;
        *) fail "source-overload knows no option $1. See: ./furrow soak source-overload --help" ;;
    esac
    (($# > 1)) || fail "$1 needs a value. See: ./furrow soak source-overload --help"
    shift 2
done
for number in "$seconds" "$senders" "$bytes" "$heap"; do
    [[ $number =~ ^[0-9]+$ && $number -ge 1 ]] || fail "'$number' is not a whole number from 1."
done
((seconds >= 40)) || fail "--seconds must be at least 40."

run=$(mktemp -d "${TMPDIR:-/tmp}/furrow-overload.XXXXXX")
logs=$home/target/soak/source-overload
trap 'stop_own; rm -rf "$run"' EXIT
trap 'exit 130' INT
trap 'exit 143' TERM
rm -rf "$logs"
mkdir -p "$logs"
build_connector

mkfifo "$run/in"
"$java" -Xmx"${heap}m" -XX:MaxDirectMemorySize=64m -XX:+ExitOnOutOfMemoryError -cp "$connector_classes" \
    io.furrow.connect.source.BlockedSource "$run/journal" <"$run/in" >"$logs/source.log" 2>&1 &
source=$!
own "$source"
exec 9>"$run/in" # it runs until its input ends
until_true 30 "The source" grep -q '^port ' "$logs/source.log"
port=$(sed -n 's/^port //p' "$logs/source.log")
"$java" -Xmx256m -cp "$connector_classes" io.furrow.connect.source.PressingSenders "$port" "$senders" "$bytes" "$seconds" \
    >"$logs/senders.log" 2>&1 &
pressing=$!
own "$pressing"

resident() { sed -n 's/^VmRSS:[^0-9]*\([0-9]*\).*/\1/p' "/proc/$source/status" 2>/dev/null || true; }
first=0
last=0
for ((passed = 10; passed <= seconds; passed += 10)); do
    sleep 10
    last=$(resident)
    [[ -n $last ]] || { tail -n 5 "$logs/source.log" >&2; fail "The source has ended."; }
    say "$((last / 1024)) MiB resident"
    ((passed > seconds / 4)) || first=$last
done
wait "$pressing" || true
say "senders: $(tail -n 1 "$logs/senders.log")"
curl -sf -m 10 "http://127.0.0.1:$port/health" >"$logs/health.json" || fail "The source does not answer any more."
say "$(cat "$logs/health.json")"
((last < first + 65536)) || fail "Its memory grew from $((first / 1024)) to $((last / 1024)) MiB."
echo "source-overload: passed"
