package io.furrow.bench.notifications;

import java.util.Map;

import io.furrow.bench.http.HttpLoadResult;

/**
 * One run of the source, and what was measured beside it.
 *
 * @param load what the senders saw
 * @param inKafkaPerSecond acknowledged notifications by the time until a reader of the topic had the last of them
 * @param missing acknowledged notifications that are not in the topic
 * @param repeats records of a notification that was in the topic already
 * @param cpuNanos processor time by part
 * @param bareServer the same load on a server that only answers
 * @param bareBridge the same load on a server that answers when Kafka has it
 * @param producerPerSecond records like these by a bare producer
 */
public record NotificationRun(
        HttpLoadResult load,
        double inKafkaPerSecond,
        long missing,
        long repeats,
        Map<String, Long> cpuNanos,
        HttpLoadResult bareServer,
        HttpLoadResult bareBridge,
        double producerPerSecond) {
    /** Notifications per second that were acknowledged and in Kafka. */
    public double perSecond() {
        return Math.min(load.perSecond(), inKafkaPerSecond);
    }

    public double ofBareServer() {
        return perSecond() / bareServer.perSecond();
    }

    public double ofBareBridge() {
        return perSecond() / bareBridge.perSecond();
    }

    public double ofProducer() {
        return perSecond() / producerPerSecond;
    }

    /** Microseconds of processor time of a part per notification. */
    public double cpuMicros(String part) {
        return load.answered() == 0 ? 0 : cpuNanos.getOrDefault(part, 0L) / 1000.0 / load.answered();
    }

    public double cpuMicros() {
        return cpuNanos.keySet().stream().mapToDouble(this::cpuMicros).sum();
    }
}
