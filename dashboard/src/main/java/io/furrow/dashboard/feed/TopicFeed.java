package io.furrow.dashboard.feed;

import java.time.Duration;
import java.util.Collection;
import java.util.List;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.CopyOnWriteArraySet;
import java.util.concurrent.CountDownLatch;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.ConsumerRecords;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.UnknownTopicOrPartitionException;
import org.apache.kafka.common.errors.WakeupException;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.dashboard.feed.StreamCounters.Count;
import io.furrow.kafka.CommittedReader;
import io.furrow.model.text.FailureText;

/** Consumes a topic from its end and fans the records out to all its streams, on its own thread. */
public final class TopicFeed implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(TopicFeed.class);
    private static final Duration POLL = Duration.ofMillis(500);
    private static final Duration CLOSE_TIMEOUT = Duration.ofSeconds(2);
    private static final Duration PARTITION_INTERVAL = Duration.ofSeconds(10);

    private final String topic;
    private final StreamLimits limits;
    private final StreamCounters counters;
    private final KafkaConsumer<byte[], byte[]> consumer;
    private final Set<Stream> streams = new CopyOnWriteArraySet<>();
    private final CountDownLatch started = new CountDownLatch(1);
    private final Thread thread;
    private volatile boolean closed;
    private volatile String failure;
    private long sequence;

    /** Receives the records of a topic. */
    public interface Stream {
        /** Queues a record. */
        void offer(FeedRecord record);

        /** Sends queued records; called after each poll. */
        void flush();

        /** Ends the stream: no record follows. */
        void end(String reason);

        boolean isClosed();
    }

    TopicFeed(String topic, Properties client, StreamLimits limits, StreamCounters counters) {
        this.topic = topic;
        this.counters = counters;
        this.limits = limits;
        this.consumer = new KafkaConsumer<>(settings(client), new ByteArrayDeserializer(), new ByteArrayDeserializer());
        this.thread = new Thread(this::run, "feed-" + topic);
        thread.setDaemon(true);
        thread.start();
    }

    private static Properties settings(Properties client) {
        Properties settings = CommittedReader.settings(client);
        settings.setProperty("fetch.max.wait.ms", "250");
        return settings;
    }

    void add(Stream stream) {
        streams.add(stream);
        if (failure != null) {
            stream.end(failure);
        }
    }

    /** Whether it has stopped because of a failure. */
    boolean hasFailed() {
        return failure != null;
    }

    /** @return whether no stream is left */
    boolean remove(Stream stream) {
        streams.remove(stream);
        return streams.isEmpty();
    }

    /** Returns once the consumer stands at the end: every record written from now on will be read. */
    void awaitStarted() throws InterruptedException {
        started.await();
    }

    private void run() {
        try (consumer) {
            assign(true);
            started.countDown();
            long assignedAt = System.nanoTime();
            while (!closed) {
                publish(consumer.poll(POLL));
                if (System.nanoTime() - assignedAt > PARTITION_INTERVAL.toNanos()) {
                    assignedAt = System.nanoTime();
                    assign(false);
                }
            }
        } catch (WakeupException e) {
            LOG.debug("the feed of {} is closed", topic, e);
        } catch (UnknownTopicOrPartitionException e) {
            LOG.debug("topic {} is gone", topic, e);
            fail("topic '%s' is not there any more".formatted(topic));
        } catch (RuntimeException e) { // its streams would stay open without records
            LOG.warn("topic {} cannot be read any more", topic, e);
            fail("topic '%s' cannot be read (%s)".formatted(topic, FailureText.of(e)));
        } finally {
            started.countDown();
        }
    }

    private void fail(String reason) {
        failure = reason;
        streams.forEach(stream -> stream.end(reason));
    }

    /** @param fromEnd whether to start at the ends; partitions that are added later are read from their beginning */
    private void assign(boolean fromEnd) {
        List<TopicPartition> all = consumer.partitionsFor(topic).stream()
                .map(each -> new TopicPartition(each.topic(), each.partition()))
                .toList();
        if (all.isEmpty()) {
            throw new UnknownTopicOrPartitionException("it has no partitions");
        }
        Collection<TopicPartition> assigned = Set.copyOf(consumer.assignment());
        if (assigned.size() == all.size()) {
            return;
        }
        consumer.assign(all);
        List<TopicPartition> added =
                all.stream().filter(each -> !assigned.contains(each)).toList();
        if (fromEnd) {
            consumer.seekToEnd(added);
        } else {
            consumer.seekToBeginning(added);
        }
        added.forEach(consumer::position); // seeking is lazy
    }

    private void publish(ConsumerRecords<byte[], byte[]> records) {
        if (records.isEmpty()) {
            return;
        }
        for (ConsumerRecord<byte[], byte[]> record : records) {
            counters.add(Count.RECORDS_READ, 1);
            FeedRecord next = new FeedRecord(record, sequence++, limits.valueBytes());
            streams.forEach(stream -> stream.offer(next));
        }
        streams.forEach(Stream::flush);
    }

    @Override
    public void close() {
        closed = true;
        consumer.wakeup();
        if (Thread.currentThread() != thread) {
            try {
                thread.join(CLOSE_TIMEOUT.toMillis());
            } catch (InterruptedException e) {
                Thread.currentThread().interrupt();
            }
        }
    }
}
