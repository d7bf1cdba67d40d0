# Prints messages, finds ports, waits and manages child processes for all soaks. Sourced, not run.
# shellcheck shell=bash disable=SC2154 # home comes from the soak

soak_name=$(basename "$0" .sh)
own_pids=()

say() { printf '%4d s  %s\n' "$SECONDS" "$1"; }
fail() { printf '%s\n' "$1" >&2; exit 1; }

# read_options NAMES ARGUMENT…: sets the variable of each argument --name VALUE, with _ for -; prints the usage for --help.
read_options() {
    local names=$1 help="See: ./furrow soak $soak_name --help" variable
    shift
    while (($# > 0)); do
        [[ $1 != -h && $1 != --help ]] || { usage && exit 0; }
        [[ $1 =~ ^--[a-z0-9-]+$ && " $names " == *" ${1#--} "* ]] || fail "$soak_name has no option $1. $help"
        (($# > 1)) || fail "$1 needs a value. $help"
        variable=${1#--}
        printf -v "${variable//-/_}" %s "$2"
        shift 2
    done
}

# check_numbers MIN NAME…: fails unless the value of each option is a whole number from MIN.
check_numbers() {
    local min=$1 name value
    for name in "${@:2}"; do
        value=${name//-/_}
        value=${!value}
        [[ $value =~ ^(0|[1-9][0-9]{0,14})$ && $value -ge $min ]] || fail "--$name must be a whole number from $min, not '$value'."
    done
}

# check_choice NAME VALUE…: fails unless the option has one of the values.
check_choice() {
    local name=$1 value=${1//-/_}
    shift
    [[ " $* " == *" ${!value} "* ]] || fail "--$name must be one of $*, not '${!value}'."
}

# own PID: registers a process to be stopped at the end.
own() { own_pids+=("$1"); }

# Sets run to a new folder and logs to an empty one; at the end stops the registered processes and removes run.
prepare() {
    run=$(mktemp -d "${TMPDIR:-/tmp}/furrow-$soak_name.XXXXXX")
    logs=$home/target/soak/$soak_name
    temporary=("$run")
    trap clean_up EXIT
    trap 'exit 130' INT
    trap 'exit 143' TERM
    rm -rf "$logs"
    mkdir -p "$logs"
}

clean_up() {
    local code=$?
    trap - EXIT INT TERM
    stop_own
    [[ $(type -t save_logs) != function ]] || save_logs
    rm -rf "${temporary[@]}"
    case $code in
        0) ;;
        130 | 143) echo "$soak_name: interrupted" ;;
        *) printf '%s: failed; logs: %s\n' "$soak_name" "$home/target/soak/$soak_name" ;;
    esac
    exit "$code"
}

# Stops the registered processes, newest first, and kills those that still run after 10 s.
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

# Sets port to a free port below the ephemeral ports, not returned before.
ports_used=" "
free_port() {
    while :; do
        port=$((20000 + RANDOM % 12000))
        [[ $ports_used != *" $port "* ]] && ! open_port "$port" && break
    done
    ports_used+="$port "
}

# until_true SECONDS WHAT COMMAND…
until_true() {
    local seconds=$1 what=$2 end=$((SECONDS + $1))
    shift 2
    until "$@" >/dev/null 2>&1; do
        ((SECONDS < end)) || fail "$what: not ready after $seconds s; logs: $logs"
        sleep 0.3
    done
}
