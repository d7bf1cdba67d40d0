# Provides a Flink distribution and a standalone cluster. Sourced, not run.
# shellcheck shell=bash disable=SC2154 # run, logs come from the soak

flink_version=2.2.1

# Sets FLINK_HOME, unless it is set, to a distribution assembled from Flink's two packages on PyPI.
provide_flink() {
    if [[ -n ${FLINK_HOME:-} ]]; then
        [[ -x $FLINK_HOME/bin/flink ]] || fail "FLINK_HOME=$FLINK_HOME has no bin/flink. Set it to a Flink $flink_version, or unset it."
        return
    fi
    local cache=${XDG_CACHE_HOME:-$HOME/.cache}/furrow
    FLINK_HOME=$cache/flink-$flink_version
    [[ -x $FLINK_HOME/bin/flink ]] || make_flink "$cache"
}

make_flink() {
    python3 -m pip --version >/dev/null 2>&1 ||
        fail "Python 3 with pip is missing, which fetches Flink. Install python3-pip, or set FLINK_HOME to a Flink $flink_version."
    mkdir -p "$1" || fail "Cannot write $1. Set XDG_CACHE_HOME to a writable folder, or FLINK_HOME to a Flink $flink_version."
    local work
    work=$(mktemp -d "$1/making.XXXXXX")
    temporary+=("$work") # if the soak is interrupted
    say "fetching Flink $flink_version, some 315 MB, into $1"
    fetch "$work" --no-binary apache-flink-libraries "apache-flink-libraries==$flink_version"
    # Only its scripts are used, which are the same on all platforms.
    fetch "$work" --only-binary :all: --implementation cp --python-version 3.11 --platform manylinux2014_x86_64 \
        "apache-flink==$flink_version"
    mkdir "$work/home" "$work/scripts"
    tar -xzf "$work"/apache*flink*libraries-*.tar.gz -C "$work"
    mv "$work"/apache*flink*libraries-"$flink_version"/deps/{lib,opt,plugins,bin} "$work/home"
    python3 -m zipfile -e "$work"/apache_flink-*.whl "$work/scripts"
    cp "$work"/scripts/pyflink/bin/* "$work/home/bin"
    cp -r "$work/scripts/pyflink/conf" "$work/home"
    chmod +x "$work"/home/bin/*
    mv "$work/home" "$FLINK_HOME"
    rm -rf "$work"
}

# fetch FOLDER PIP-OPTIONS…: downloads a package and shows the progress.
fetch() {
    local folder=$1 log=$1/pip.log pip
    shift
    TMPDIR=$folder python3 -m pip download --no-deps --disable-pip-version-check --dest "$folder" "$@" >"$log" 2>&1 &
    pip=$!
    own "$pip"
    while kill -0 "$pip" 2>/dev/null; do
        printf '\r\033[K%4d s  %s' "$SECONDS" "$(du -sm "$folder" | cut -f1) MB"
        sleep 1
    done
    printf '\r\033[K'
    wait "$pip" || { tail -n 3 "$log" >&2; rm -rf "$folder"; fail "Cannot fetch Flink. Set FLINK_HOME to a Flink $flink_version."; }
}

# start_flink [SETTING…]: starts a job manager and a task manager below $run; sets rest. A setting is a line of config.yaml.
# The task manager has $task_slots slots (6) and $task_manager_memory (1536m).
start_flink() {
    local port rpc opens
    free_port && rest=http://127.0.0.1:$port
    local rest_port=$port
    free_port && rpc=$port
    opens=$(grep -oE -- '--add-exports=java.rmi.*' "$FLINK_HOME/conf/config.yaml" | head -n 1)
    cp -r "$FLINK_HOME/conf" "$run/flink-conf"
    cat "$home/docker/flink/log4j.properties" >>"$run/flink-conf/log4j-console.properties"
    cat >"$run/flink-conf/config.yaml" <<YAML
env.java.opts.all: $opens
rest.address: 127.0.0.1
rest.bind-address: 127.0.0.1
rest.port: $rest_port
jobmanager.rpc.address: 127.0.0.1
jobmanager.rpc.port: $rpc
jobmanager.bind-host: 127.0.0.1
jobmanager.memory.process.size: 1024m
taskmanager.host: 127.0.0.1
taskmanager.bind-host: 127.0.0.1
taskmanager.memory.process.size: ${task_manager_memory:-1536m}
taskmanager.numberOfTaskSlots: ${task_slots:-6}
io.tmp.dirs: $run/flink-tmp
execution.checkpointing.dir: file://$run/checkpoints
YAML
    (($# == 0)) || printf '%s\n' "$@" >>"$run/flink-conf/config.yaml"
    export FLINK_CONF_DIR=$run/flink-conf FLINK_PID_DIR=$run FLINK_LOG_DIR=$logs
    mkdir -p "$run/flink-tmp"
    "$FLINK_HOME/bin/jobmanager.sh" start-foreground >"$logs/jobmanager.out" 2>&1 &
    own $!
    start_task_manager
    until_true 90 "A task manager of the Flink cluster at $rest" has_slots
}

# Sets task_manager to the process: the scripts exec it.
start_task_manager() {
    "$FLINK_HOME/bin/taskmanager.sh" start-foreground >>"$logs/taskmanager.out" 2>&1 &
    task_manager=$!
    own "$task_manager"
}

has_slots() { curl -fs "$rest/overview" | grep -q '"slots-total":[1-9]'; }
