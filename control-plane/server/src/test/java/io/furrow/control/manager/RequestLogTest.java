package io.furrow.control.manager;

import java.time.Duration;

import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.streams.Topology;
import org.apache.kafka.streams.TopologyTestDriver;
import org.apache.kafka.streams.processor.api.ContextualProcessor;
import org.apache.kafka.streams.processor.api.MockProcessorContext;
import org.apache.kafka.streams.processor.api.Record;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class RequestLogTest {
    private static final Duration RETENTION = Duration.ofHours(1);
    private static final long NOW = 1_700_000_000_000L;
    private static final long AHEAD = NOW + 2 * RETENTION.toMillis();

    private final MockProcessorContext<String, byte[]> context = new MockProcessorContext<>();

    @AutoClose
    private final TopologyTestDriver driver = new TopologyTestDriver(new Topology()
            .addSource("in", new ByteArrayDeserializer(), new ByteArrayDeserializer(), "in")
            .addProcessor(
                    "log-requests",
                    () -> new ContextualProcessor<byte[], byte[], Void, Void>() {
                        @Override
                        public void process(Record<byte[], byte[]> record) {}
                    },
                    "in")
            .addStateStore(RequestLog.builder("log", RETENTION), "log-requests"));

    private RequestLog log;

    @BeforeEach
    void open() {
        context.addStateStore(driver.getWindowStore("log"));
        log = log();
    }

    @Test
    void forgetsARequestAfterTheRetention() {
        log.add("r-1", "f", NOW);
        assertThat(log.fingerprint("r-1", NOW + RETENTION.toMillis())).contains("f");
        assertThat(log.fingerprint("r-1", NOW + RETENTION.toMillis() * 5 / 4)).isEmpty();
    }

    /** The store has dropped what is an hour older than its newest window. */
    @Test
    void remembersRequestsAfterTheClockWentBack() {
        log.add("r-1", "f", AHEAD);
        log.add("r-2", "g", NOW);
        assertThat(log.fingerprint("r-1", NOW)).contains("f");
        assertThat(log.fingerprint("r-2", NOW)).contains("g");

        log = log(); // of another instance
        log.add("r-3", "h", NOW + 1);
        assertThat(log.fingerprint("r-2", NOW + 1)).contains("g");
        assertThat(log.fingerprint("r-3", NOW + 1)).contains("h");
    }

    @Test
    void forgetsRequestsAfterTheClockWentBack() {
        log.add("r-1", "f", AHEAD);
        log.add("r-2", "g", NOW);
        long later = NOW + RETENTION.toMillis() * 5 / 4;
        assertThat(log.fingerprint("r-2", later)).isEmpty();
        log.add("r-3", "h", later);
        assertThat(log.fingerprint("r-3", later)).contains("h");
    }

    private RequestLog log() {
        return new RequestLog(context, "log", RETENTION);
    }
}
