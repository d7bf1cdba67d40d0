# What every soak needs of the machine: sentences, ports, waiting, processes of its own. Sourced, not run.
# shellcheck shell=bash

own_pids=()

say() { printf '%4d s  %s\n' "$SECONDS" "$1"; }
fail() { printf '%s\n' "$1" >&2; exit 1; }

# The process that was started last is ours to stop.
own() { own_pids+=("$1"); }

# Stops what we own, youngest first: first asked, after 10 s without asking.
stop_own() {
    local i pid tries
    for ((i = ${#own_pids[@]} - 1; i >= 0; i--)); do
        pid=${own_pids[i]}
        kill "$pid" 2>/dev/null || continue
        for ((tries = 0; tries < 100; tries++)); do
            kill -0 "$pid" 2>/dev/null || break
            sleep 0.1
        done
        kill -9 "$pid" 2>/dev/null || true
        wait "$pid" 2>/dev/null || true
    done
    own_pids=()
}

open_port() { (exec 3<>"/dev/tcp/127.0.0.1/$1") 2>/dev/null; }

# A port below those that systems give to clients, free at this moment and not given out before.
ports_given=" "
free_port() {
    while :; do
        port=$((20000 + RANDOM % 12000))
        [[ $ports_given != *" $port "* ]] && ! open_port "$port" && break
    done
    ports_given+="$port "
}

# until_true SECONDS WHAT COMMAND…
until_true() {
    local seconds=$1 what=$2 end=$((SECONDS + $1))
    shift 2
    until "$@" >/dev/null 2>&1; do
        ((SECONDS < end)) || fail "$what was not there after $seconds s; logs: $logs"
        sleep 0.3
    done
}
