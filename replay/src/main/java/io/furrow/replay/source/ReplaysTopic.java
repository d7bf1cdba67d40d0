package io.furrow.replay.source;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.locks.LockSupport;

import org.apache.kafka.clients.consumer.ConsumerConfig;
import org.apache.kafka.common.errors.RetriableException;
import org.apache.kafka.common.errors.WakeupException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.kafka.KafkaTopicSnapshot;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.kafka.CommittedReader;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.Topics;

/**
 * Reads the desired replays from {@code service.replays}, and earlier statuses from {@code service.replays.status}.
 * Waits for a topic that does not exist.
 */
public final class ReplaysTopic implements DesiredReplays {
    private static final long serialVersionUID = 1L;
    private static final Logger LOG = LoggerFactory.getLogger(ReplaysTopic.class);
    private static final Duration POLL = Duration.ofMillis(500);

    private final Properties client;
    private final TopicSnapshot statuses;

    public ReplaysTopic(JobOptions options) {
        client = options.kafkaProperties();
        client.setProperty(ConsumerConfig.BOOTSTRAP_SERVERS_CONFIG, options.bootstrapServers());
        statuses = new KafkaTopicSnapshot(options, Topics.REPLAYS_STATUS);
    }

    @Override
    public boolean isBounded() {
        return false;
    }

    @Override
    public Reading open() {
        return new FromKafka(CommittedReader.unassigned(client), statuses);
    }

    private static String text(byte[] key) {
        return key == null ? null : new String(key, StandardCharsets.UTF_8);
    }

    /** Returns the newest status of each replay; never holds more than one per replay in memory. */
    static List<ReportedStatus> newest(TopicSnapshot statuses) throws IOException {
        Map<String, TopicRecord> newest = new HashMap<>();
        statuses.forEach(record -> {
            if (record.value() == null) {
                newest.remove(text(record.key()));
            } else if (record.key() != null) {
                newest.put(text(record.key()), record);
            }
        });
        List<ReportedStatus> reported = new ArrayList<>();
        newest.forEach((replay, record) -> {
            try {
                reported.add(new ReportedStatus(replay, ReplayStatus.read(record.value())));
            } catch (UnreadableException e) {
                LOG.warn("Skipping the status {}", record.position(), e);
            }
        });
        return reported;
    }

    private static final class FromKafka implements Reading {
        private final CommittedReader<String> reader;
        private final TopicSnapshot statuses;
        private boolean assigned;
        private volatile boolean closed;

        FromKafka(CommittedReader<String> reader, TopicSnapshot statuses) {
            this.reader = reader;
            this.statuses = statuses;
        }

        @Override
        public List<ReportedStatus> reportedStatuses() throws IOException {
            return newest(statuses);
        }

        @Override
        public synchronized List<ReplayUpdate> poll() throws IOException {
            List<ReplayUpdate> updates = new ArrayList<>();
            try {
                if (!closed && (assigned || assign())) {
                    reader.poll(POLL).forEach(record -> updates.add(new ReplayUpdate(record.key(), record.value())));
                }
            } catch (WakeupException e) { // it is being closed
                return List.of();
            } catch (RetriableException e) {
                throw unavailable(e);
            }
            return updates;
        }

        private boolean assign() {
            assigned = reader.assign(List.of(Topics.REPLAYS));
            if (!assigned) {
                LockSupport.parkNanos(POLL.toNanos());
            }
            return assigned;
        }

        @Override
        public synchronized boolean isCaughtUp() throws IOException {
            try {
                return !closed && assigned && reader.isCaughtUp();
            } catch (WakeupException e) { // it is being closed
                return false;
            } catch (RetriableException e) {
                throw unavailable(e);
            }
        }

        private static IOException unavailable(RetriableException failure) {
            return new IOException(Topics.REPLAYS + " cannot be read: " + FailureText.of(failure), failure);
        }

        @Override
        public void close() {
            closed = true;
            reader.wakeup();
            synchronized (this) {
                reader.close();
            }
        }
    }
}
