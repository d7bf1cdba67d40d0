package io.furrow.replay.source;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Properties;
import java.util.concurrent.locks.LockSupport;

import org.apache.kafka.clients.consumer.ConsumerConfig;
import org.apache.kafka.common.errors.WakeupException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.flink.job.JobOptions;
import io.furrow.flink.kafka.KafkaTopicSnapshot;
import io.furrow.flink.kafka.TopicSnapshot;
import io.furrow.flink.record.TopicRecord;
import io.furrow.kafka.CommittedReader;
import io.furrow.model.control.replay.ReplayStatus;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** What {@code service.replays} says, and {@code service.replays.status} of the time before. A topic that is not there is awaited. */
public final class ReplaysTopic implements WantedReplays {
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
        public List<Told> told() throws IOException {
            List<Told> told = new ArrayList<>();
            for (TopicRecord record : statuses.read()) {
                try {
                    if (record.key() != null && record.value() != null) {
                        told.add(new Told(text(record.key()), ReplayStatus.read(record.value())));
                    }
                } catch (UnreadableException e) {
                    LOG.warn("The status {} is passed over", record.position(), e);
                }
            }
            return told;
        }

        @Override
        public synchronized List<Wish> poll() {
            List<Wish> wishes = new ArrayList<>();
            try {
                if (!closed && (assigned || assign())) {
                    reader.poll(POLL).forEach(record -> wishes.add(new Wish(record.key(), record.value())));
                }
            } catch (WakeupException e) { // it is being closed
                return List.of();
            }
            return wishes;
        }

        private boolean assign() {
            assigned = reader.assign(List.of(Topics.REPLAYS));
            if (!assigned) {
                LockSupport.parkNanos(POLL.toNanos());
            }
            return assigned;
        }

        @Override
        public synchronized boolean isCaughtUp() {
            return !closed && assigned && reader.isCaughtUp();
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
