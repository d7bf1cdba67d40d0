package io.furrow.launcher.replay;

import java.time.Duration;
import java.util.Collection;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.CommittedReader;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Follows {@code service.replays} and {@code service.replays.status} from their beginning. */
final class ReplaysReader implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(ReplaysReader.class);
    private static final List<String> TOPICS = List.of(Topics.REPLAYS, Topics.REPLAYS_STATUS);

    private final CommittedReader<String> reader;
    private final Map<String, DesiredReplay> desired = new HashMap<>();
    private final Map<String, ReplayStatus> statuses = new HashMap<>();
    private boolean assigned;

    /** @param client settings of Kafka clients, with {@code bootstrap.servers} */
    ReplaysReader(Properties client) {
        reader = CommittedReader.unassigned(client);
    }

    /** Polls for records. @return whether everything has been read that existed at the first poll */
    boolean poll(Duration timeout) {
        assigned = assigned || reader.assign(TOPICS);
        if (!assigned) {
            return false;
        }
        reader.poll(timeout).forEach(this::read);
        return reader.isCaughtUp();
    }

    private void read(ConsumerRecord<String, byte[]> record) {
        boolean status = record.topic().equals(Topics.REPLAYS_STATUS);
        if (record.value() == null) {
            (status ? statuses : desired).remove(record.key());
            return;
        }
        try {
            if (status) {
                statuses.put(record.key(), ReplayStatus.read(record.value()));
            } else {
                desired.put(record.key(), DesiredReplay.read(record.key(), record.value()));
            }
        } catch (UnreadableException e) {
            LOG.warn("{}-{}@{} is skipped", record.topic(), record.partition(), record.offset(), e);
        }
    }

    /** The desired jobs of each replay. */
    Collection<DesiredAnalytics> desired() {
        return desired.values().stream()
                .map(replay -> DesiredAnalytics.of(replay, statuses.get(replay.replay())))
                .toList();
    }

    @Override
    public void close() {
        reader.close();
    }
}
