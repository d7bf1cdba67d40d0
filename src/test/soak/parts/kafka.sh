# Starts a Kafka broker as a process. Sourced, not run.
# shellcheck shell=bash disable=SC2154 # run, logs, classes and java come from the soak

# start_kafka: starts a broker on a free port, with its files below $run; sets bootstrap.
start_kafka() {
    local port controller
    free_port && bootstrap=127.0.0.1:$port
    free_port && controller=127.0.0.1:$port
    cat >"$run/kafka.properties" <<PROPERTIES
process.roles=broker,controller
node.id=1
controller.quorum.voters=1@$controller
listeners=PLAINTEXT://$bootstrap,CONTROLLER://$controller
advertised.listeners=PLAINTEXT://$bootstrap
controller.listener.names=CONTROLLER
inter.broker.listener.name=PLAINTEXT
listener.security.protocol.map=PLAINTEXT:PLAINTEXT,CONTROLLER:PLAINTEXT
log.dirs=$run/kafka
num.partitions=4
offsets.topic.num.partitions=4
offsets.topic.replication.factor=1
transaction.state.log.num.partitions=4
transaction.state.log.replication.factor=1
transaction.state.log.min.isr=1
share.coordinator.state.topic.replication.factor=1
share.coordinator.state.topic.min.isr=1
group.initial.rebalance.delay.ms=0
log.cleaner.dedupe.buffer.size=8388608
PROPERTIES
    local id
    id=$("$java" -cp "$classes" kafka.tools.StorageTool random-uuid)
    "$java" -cp "$classes" kafka.tools.StorageTool format -t "$id" -c "$run/kafka.properties" >"$logs/kafka.out"
    "$java" -Xmx384m -Dfurrow.log="$logs/kafka.log" -cp "$classes" kafka.Kafka "$run/kafka.properties" \
        >>"$logs/kafka.out" 2>&1 &
    own $!
    until_true 60 "The Kafka broker" open_port "${bootstrap#*:}"
}
