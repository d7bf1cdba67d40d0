# Makes the images of docker/compose.yaml on a machine that pulls none. Sourced, not run.
# shellcheck shell=bash disable=SC2154 # run, logs, soak, archive come from the soak

kafka_version=4.2.1
hadoop_version=3.4.2

# make_images: builds the images that the file names, and Furrow's own by docker/Dockerfile from $archive.
make_images() {
    local context=$run/images kafka=$home/target/soak/kafka-image-$kafka_version hadoop=$home/target/soak/hadoop-image-$hadoop_version
    podman image exists furrow-debian || import_debian
    fetch_jars "$kafka" "org.apache.kafka:"{connect-runtime,kafka_2.13,kafka-tools}":$kafka_version" "org.apache.logging.log4j:log4j-"{slf4j-impl,core}:2.25.3
    fetch_jars "$hadoop" "org.apache.hadoop:hadoop-client-"{api,runtime,minicluster}":$hadoop_version" javax.xml.bind:jaxb-api:2.3.1 javax.activation:javax.activation-api:1.2.0
    provide_flink
    cp -r "$soak/parts/images" "$context"
    cp -r "$kafka" "$context/kafka"
    cp -r "$hadoop" "$context/hadoop"
    cp -r "$FLINK_HOME" "$context/flink"
    mkdir "$context/stand-ins"
    cp -r "$home/src/target/test-classes" "$context/stand-ins/classes"
    cp -r "$archive/lib" "$context/stand-ins/lib"
    build_image mosquitto eclipse-mosquitto:2.0.22 "$context" Dockerfile
    build_image kafka "apache/kafka:$kafka_version" "$context" Dockerfile
    build_image flink flink:2.2.1-java17 "$context" Dockerfile
    build_image hadoop apache/hadoop:3.4.1 "$context" Dockerfile
    build_image stand-ins furrow-stand-ins:latest "$context" Dockerfile
    podman tag furrow-debian docker.io/library/furrow-debian eclipse-temurin:17.0.17_10-jre-noble
    build_image furrow furrow:local "$archive" docker/Dockerfile
    for target in connect flink hadoop; do build_image "$target" "furrow-$target:local" "$archive" docker/Dockerfile; done
}

import_debian() {
    local mirror
    mirror=$(sed -n 's/^URIs: *//p' /etc/apt/sources.list.d/*.sources | head -n 1)
    say "making an image of Debian"
    mmdebstrap --variant=minbase --include=ca-certificates,curl,wget,procps,socat,openjdk-17-jre-headless,mosquitto,mosquitto-clients \
        --customize-hook='copy-in /etc/ssl/certs/ca-certificates.crt /etc/ssl/certs' \
        bookworm "$run/debian.tar" "$mirror" >"$logs/debian.log" 2>&1 || fail "Cannot make an image of Debian: $logs/debian.log"
    podman import "$run/debian.tar" furrow-debian >>"$logs/debian.log" 2>&1
    rm "$run/debian.tar"
}

# build_image TARGET NAME CONTEXT FILE: names it as Docker's interface and as a Dockerfile look for it.
build_image() {
    local registry=docker.io/library
    [[ $2 != */* ]] || registry=docker.io
    say "image $2"
    podman build --network host --target "$1" -t "$2" -t "$registry/$2" -f "$3/$4" "$3" >"$logs/image-$1.log" 2>&1 || fail "Cannot build $2: $logs/image-$1.log"
}

# provide_compose: sets compose to Docker Compose, which is built with Go if Docker's command has none.
provide_compose() {
    local version=2.40.3 cache=${XDG_CACHE_HOME:-$HOME/.cache}/furrow folder
    compose=$cache/docker-compose-$version
    [[ ! -x $compose ]] || return 0
    command -v go >/dev/null || fail "Go is missing, which builds Docker Compose. Install golang."
    say "building Docker Compose $version"
    folder=$(go mod download -json "github.com/docker/compose/v2@v$version" | sed -n 's/.*"Dir": "\(.*\)".*/\1/p')
    cp -r "$folder" "$run/compose"
    chmod -R u+w "$run/compose"
    mkdir -p "$cache"
    (cd "$run/compose" && go build -trimpath -o "$compose" ./cmd) >"$logs/compose.log" 2>&1 || fail "Cannot build Docker Compose: $logs/compose.log"
}
