package io.furrow.connect.source;

import java.lang.management.ManagementFactory;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.Map;
import javax.management.ObjectName;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.FreePort;
import io.furrow.process.Ports;

import static org.assertj.core.api.Assertions.assertThat;

class NgsiSourceTaskTest {
    private final int port = FreePort.orFree(0);
    private final SourceOnConnect source = new SourceOnConnect(port);
    private final Offsets offsets = new Offsets();

    @TempDir
    private Path directory;

    /** Remembers whether the source still listened when it asked last. */
    private final class Offsets extends HashMap<Map<String, ?>, Map<String, ?>> {
        private static final long serialVersionUID = 1L;

        private volatile boolean listening;

        @Override
        public Map<String, ?> get(Object partition) {
            listening = Ports.isListening(port);
            return super.get(partition);
        }
    }

    @Test
    void answersNothingMoreBeforeItAsksForTheLastTimeWhatKafkaHas() throws Exception {
        NgsiSourceTask task = started("asking");
        source.take("a", 1);
        SourceOnConnect.await().until(() -> offsets.listening);

        task.stop();

        assertThat(offsets.listening).isFalse();
    }

    @Test
    void showsWhatItLeavesOnTheDiskUntilAnotherTaskTakesItOver() throws Exception {
        NgsiSourceTask task = started("leaving");
        assertThat(left("leaving")).isZero();
        source.take("a", 3);
        String journal = journal("leaving");
        offsets.put(SourceOffsets.partition(journal), SourceOffsets.offsetOf(0));

        task.stop();

        assertThat(left("leaving")).isEqualTo(2);
        NgsiSourceTask next = started("leaving");
        try {
            assertThat(left("leaving")).isZero();
            assertThat(next.poll()).hasSize(2);
        } finally {
            next.stop();
        }
        assertThat(left("leaving")).as("Kafka has not acknowledged them").isEqualTo(2);
        offsets.put(SourceOffsets.partition(journal), SourceOffsets.offsetOf(2));
        started("leaving").stop();
        assertThat(left("leaving")).isZero();
    }

    private NgsiSourceTask started(String name) {
        NgsiSourceTask task = new NgsiSourceTask();
        task.initialize(new StubContext(Map.of(), offsets));
        task.start(Map.of(
                "name",
                name,
                "listen.port",
                Integer.toString(port),
                "journal.dir",
                directory.toString(),
                "topic",
                "raw"));
        return task;
    }

    private String journal(String name) {
        return directory.resolve(name).toFile().list()[0];
    }

    private static long left(String name) throws Exception {
        ObjectName bean = new ObjectName("furrow.connect:type=ngsi-source-left,connector=" + name);
        return (long) ManagementFactory.getPlatformMBeanServer().getAttribute(bean, "left-records");
    }
}
