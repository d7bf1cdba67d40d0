package io.furrow.connect.source;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.ledger.Counter;
import io.furrow.connect.ledger.Gauge;
import io.furrow.connect.ledger.LedgerBean;
import io.furrow.connect.ledger.Numbers;

/**
 * Shows what the tasks of a connector left on this worker's disk when they ended or moved: records that were answered 200 and
 * are not in Kafka by the offsets that Connect had then. It stays on JMX without a task, as
 * {@code furrow.connect:type=ngsi-source-left,connector=…}, until a task on this worker takes the journals over.
 */
final class LeftRecords implements Numbers {
    private static final Logger LOG = LoggerFactory.getLogger(LeftRecords.class);
    private static final Map<String, LeftRecords> OF_CONNECTORS = new ConcurrentHashMap<>();

    private final String connector;
    private final Map<Path, Long> records = new ConcurrentHashMap<>();

    private LeftRecords(String connector) {
        this.connector = connector;
    }

    /** Those of a connector in this process. */
    static LeftRecords of(String connector) {
        return OF_CONNECTORS.computeIfAbsent(connector, name -> {
            LeftRecords left = new LeftRecords(name);
            LedgerBean.show(left, "ngsi-source-left", name);
            return left;
        });
    }

    /** A task ended. */
    void leave(Path journal, long left) {
        if (left > 0) {
            records.put(journal, left);
            LOG.info(
                    "{}: {} records in {} are not in Kafka; the next task of the connector on this worker takes them there",
                    connector,
                    left,
                    journal);
        }
    }

    /** A task has the journal. */
    void take(Path journal) {
        records.remove(journal);
    }

    private Map<Path, Long> now() {
        records.keySet().removeIf(journal -> !Files.isDirectory(journal));
        return records;
    }

    @Override
    public List<Counter> counters() {
        return List.of();
    }

    @Override
    public List<Gauge> gauges() {
        return List.of(
                new Gauge(
                        "leftRecords",
                        "Records on this worker's disk that are not in Kafka and that no task of the connector here has",
                        () -> now().values().stream().mapToLong(Long::longValue).sum()),
                new Gauge("leftJournals", "Journals that hold them", () -> now().size()));
    }
}
