package io.furrow.connect.source.journal;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.ledger.LedgerBean;
import io.furrow.connect.ledger.Metrics;

/**
 * Reports the records that the tasks of a connector left on this worker's disk when they stopped or moved: records that
 * were answered 200 and were not in Kafka according to the offsets of that time. It stays registered in JMX without a
 * task, as {@code furrow.connect:type=ngsi-source-left,connector=…}, until a task on this worker takes over the
 * journals.
 */
final class UndeliveredRecords extends Metrics {
    private static final Logger LOG = LoggerFactory.getLogger(UndeliveredRecords.class);
    private static final Map<String, UndeliveredRecords> OF_CONNECTORS = new ConcurrentHashMap<>();

    private final String connector;
    private final Map<Path, Long> records = new ConcurrentHashMap<>();

    private UndeliveredRecords(String connector) {
        this.connector = connector;
        gauge(
                "leftRecords",
                "Records on this worker's disk that are not in Kafka and that no task of the connector here has",
                () -> now().values().stream().mapToLong(Long::longValue).sum());
        gauge("leftJournals", "Journals that contain them", () -> now().size());
    }

    /** The left records of a connector in this process. */
    static UndeliveredRecords of(String connector) {
        return OF_CONNECTORS.computeIfAbsent(connector, name -> {
            UndeliveredRecords left = new UndeliveredRecords(name);
            LedgerBean.show(left, "ngsi-source-left", name);
            return left;
        });
    }

    /** A task stopped. */
    void leave(Path journal, long left) {
        if (left > 0) {
            records.put(journal, left);
            LOG.info(
                    "{}: {} records in {} are not in Kafka; the next task of the connector on this worker writes them",
                    connector,
                    left,
                    journal);
        }
    }

    /** A task opened the journal. */
    void take(Path journal) {
        records.remove(journal);
    }

    private Map<Path, Long> now() {
        records.keySet().removeIf(journal -> !Files.isDirectory(journal));
        return records;
    }
}
