package io.furrow.bench.notifications;

import java.net.InetSocketAddress;
import java.nio.charset.StandardCharsets;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.locks.LockSupport;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.HdrHistogram.Histogram;
import org.HdrHistogram.SynchronizedHistogram;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.ConsumerRecords;

import io.furrow.bench.frame.Engines;
import io.furrow.bench.frame.TopicReader;
import io.furrow.bench.http.HttpLoad;
import io.furrow.bench.http.NotificationRequest;
import io.furrow.cli.control.client.ControlApi;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.launcher.suite.Suite;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;

/**
 * Measures the path from the notification to the mission's topic, with everything that a suite does beside it: sends notifications
 * to its listener at a fixed rate, of entities of one mission, and reads them at the mission's topic.
 */
final class SuiteLoad {
    private static final String DOMAIN = "bench";
    private static final String MISSION = "notified";
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;
    private static final long NUMBERS_PER_RUN = 1_000_000_000L;
    private static final long MAX_MILLIS = 600_000;
    private static final int DIGITS = 3;
    private static final double HELD_MILLIS = 1_000;
    private static final double P99 = 99;

    private final Suite suite;
    private long firstNumber = NUMBERS_PER_RUN;

    /** @param entities of the mission, which is started */
    SuiteLoad(Suite suite, int entities) throws InterruptedException, ExecutionException {
        this.suite = suite;
        Engines.makeTopics(
                suite.kafka().clientProperties(), EmbeddedKafka.PARTITIONS, Map.of(), Topics.realtime(DOMAIN, MISSION));
        ControlApi api = new ControlApi(suite.control(), null);
        api.send("POST", "/api/domains", NODES.objectNode().put("domain", DOMAIN));
        ObjectNode plan = NODES.objectNode().put("domain", DOMAIN);
        ArrayNode devices = plan.putArray("devices");
        for (int number = 0; number < entities; number++) {
            devices.add(NotificationRequest.id(number));
        }
        api.send("POST", "/api/missions/" + MISSION + "/start", plan);
    }

    /**
     * The result of one rate.
     *
     * @param load the senders' result
     * @param missing acknowledged notifications that are not on the mission's topic
     * @param repeats repeated records there
     * @param delay milliseconds from the receipt by the source to the reader
     */
    record Run(HttpLoad.Result load, long missing, long repeats, Histogram delay) {
        /** Whether all were acknowledged and arrived once, 99 of 100 within a second. */
        boolean isHeld() {
            return load.refused() + load.broken() + missing + repeats == 0 && millis(P99) <= HELD_MILLIS;
        }

        double millis(double percentile) {
            return delay.getValueAtPercentile(percentile);
        }
    }

    Run run(HttpLoad.Plan plan) {
        firstNumber += NUMBERS_PER_RUN;
        ArrivalCheck check = new ArrivalCheck(firstNumber);
        Histogram delay = new SynchronizedHistogram(MAX_MILLIS, DIGITS);
        Properties kafka = suite.kafka().clientProperties();
        try (TopicReader reader = TopicReader.fromEnd(kafka, TopicReader.COMMITTED, Topics.realtime(DOMAIN, MISSION))) {
            reader.follow(records -> {
                check.add(records);
                add(records, delay);
            });
            InetSocketAddress listener = new InetSocketAddress(
                    suite.listener().getHost(), suite.listener().getPort());
            HttpLoad.Result load = new HttpLoad(listener, plan, firstNumber).run();
            check.await(load.acknowledged(), arrived -> {});
            LockSupport.parkNanos(TimeUnit.SECONDS.toNanos(1)); // duplicates in flight
            return new Run(load, check.missing(load.acknowledged()), check.repeats(), delay);
        }
    }

    private static void add(ConsumerRecords<byte[], byte[]> records, Histogram delay) {
        long now = System.currentTimeMillis();
        for (ConsumerRecord<byte[], byte[]> record : records) {
            byte[] source = record.headers().lastHeader(HeaderNames.TS_SOURCE).value();
            long millis = now - Long.parseLong(new String(source, StandardCharsets.UTF_8));
            delay.recordValue(Math.max(0, Math.min(MAX_MILLIS, millis)));
        }
    }
}
