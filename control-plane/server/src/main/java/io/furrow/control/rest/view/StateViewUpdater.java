package io.furrow.control.rest.view;

import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.OffsetSpec;
import org.apache.kafka.clients.consumer.Consumer;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.ConsumerRecords;
import org.apache.kafka.clients.consumer.OffsetAndTimestamp;
import org.apache.kafka.common.PartitionInfo;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.UnknownTopicOrPartitionException;
import org.apache.kafka.common.errors.WakeupException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.kafka.CommittedReader;
import io.furrow.kafka.ComponentStatus;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.RequestFingerprint;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.Topics;

/**
 * Reads the committed records of the control plane's topics, with a consumer without a group, so that each instance
 * reads all. Answers pass through the {@link ReadYourWritesBarrier}.
 */
public final class StateViewUpdater implements AutoCloseable {
    static final List<String> MANAGERS =
            List.of(Topics.DOMAIN_MANAGER, Topics.MISSION_MANAGER, Topics.REPLAY_MANAGER, Topics.ALARM_MANAGER);

    private static final Logger LOG = LoggerFactory.getLogger(StateViewUpdater.class);
    private static final Duration POLL = Duration.ofMillis(100);
    private static final Duration POLL_WITH_ANSWERS = Duration.ofMillis(5);
    private static final long PAUSE_MS = 1000;
    private static final long TIMEOUT_SECONDS = 10;

    private final Properties settings;
    private final Duration answerRetention;
    private final StateView view;
    private final PendingReplies answers;
    private final CountDownLatch closing = new CountDownLatch(1);
    private final Thread thread = new Thread(this::run, "control-plane-view");
    private volatile Consumer<String, byte[]> consumer;
    private volatile Instant lastPoll;
    private volatile String failure = "";

    /** @param answerRetention age of the oldest answers that are read at the start */
    public StateViewUpdater(Properties client, Duration answerRetention, StateView view, PendingReplies answers) {
        this.settings = CommittedReader.settings(client);
        this.answerRetention = answerRetention;
        this.view = view;
        this.answers = answers;
    }

    public void start() {
        view.clear();
        thread.setDaemon(true);
        thread.start();
    }

    public ComponentStatus status() {
        ComponentStatus.State state = !thread.isAlive()
                ? ComponentStatus.State.DEAD
                : view.isComplete() ? ComponentStatus.State.UP : ComponentStatus.State.DOWN;
        return new ComponentStatus(
                "api", state, lastPoll, state == ComponentStatus.State.UP ? "" : "reads its topics; " + failure);
    }

    /** Clears the view when the thread ends: nothing would update it any more. */
    private void run() {
        try {
            follow();
        } finally {
            view.clear();
        }
    }

    private void follow() {
        while (closing.getCount() > 0) {
            try (Admin admin = Admin.create(settings);
                    Consumer<String, byte[]> fresh = KafkaClients.consumer(settings)) {
                consumer = fresh;
                view.clear();
                read(fresh, admin);
            } catch (WakeupException e) { // the loop checks whether it is closed
                LOG.debug("the view of the control plane's topics was woken up", e);
            } catch (RuntimeException e) { // Kafka is unavailable, or a bug
                LOG.warn("the view of the control plane's topics failed and is rebuilt", e);
                failure = FailureText.of(e);
                view.clear();
                pause();
            }
        }
    }

    private void pause() {
        try {
            closing.await(PAUSE_MS, TimeUnit.MILLISECONDS);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            closing.countDown();
        }
    }

    /** @param admin queries the ends of topics: the broker would queue such a request of the consumer behind its pending fetch */
    private void read(Consumer<String, byte[]> from, Admin admin) {
        List<TopicPartition> viewed = partitions(from, StateView.TOPICS);
        List<TopicPartition> all = begin(from, viewed);
        Map<TopicPartition, Long> ends = from.endOffsets(all);
        Map<TopicPartition, OffsetSpec> latest = new HashMap<>();
        viewed.stream()
                .filter(each -> !each.topic().equals(Topics.DEVICES_HEALTH)) // no command changes it
                .forEach(each -> latest.put(each, OffsetSpec.latest()));
        ReadYourWritesBarrier barrier = new ReadYourWritesBarrier(answers);
        while (closing.getCount() > 0) {
            Map<PendingReplies.Key, CommandResult> fresh =
                    take(from.poll(barrier.isEmpty() ? POLL : POLL_WITH_ANSWERS));
            lastPoll = Instant.now();
            if (!view.isComplete() && ReadYourWritesBarrier.reached(ends, from::position)) {
                view.complete();
                LOG.info("the view of the control plane's topics is complete");
            }
            if (!fresh.isEmpty()) {
                // The high watermark: the effect of an answer may lie behind a transaction that is still open.
                barrier.hold(fresh, admin.listOffsets(latest).all());
            }
            barrier.release(from::position);
        }
    }

    /** Seeks cached topics to the beginning, managers' topics to the oldest relevant answer, and the audit to its end. */
    private List<TopicPartition> begin(Consumer<String, byte[]> from, List<TopicPartition> viewed) {
        List<TopicPartition> managers = partitions(from, MANAGERS);
        List<TopicPartition> audit = partitions(from, List.of(Topics.AUDIT));
        List<TopicPartition> all = new ArrayList<>(viewed);
        all.addAll(managers);
        all.addAll(audit);
        from.assign(all);
        from.seekToBeginning(viewed);

        Map<TopicPartition, Long> since = new HashMap<>();
        managers.forEach(each -> since.put(each, System.currentTimeMillis() - answerRetention.toMillis()));
        Map<TopicPartition, OffsetAndTimestamp> found = from.offsetsForTimes(since);
        Map<TopicPartition, Long> ends = from.endOffsets(all);
        Map<TopicPartition, Long> beginOffsets = from.beginningOffsets(audit);
        for (TopicPartition each : managers) {
            from.seek(
                    each,
                    found.get(each) == null ? ends.get(each) : found.get(each).offset());
        }
        for (TopicPartition each : audit) { // twice the offsets, because every transaction also has a marker
            long start = Math.max(beginOffsets.get(each), ends.get(each) - 2L * StateView.AUDITED);
            from.seek(each, start);
            view.auditFrom(start == beginOffsets.get(each));
        }
        return all;
    }

    private static List<TopicPartition> partitions(Consumer<String, byte[]> consumer, List<String> topics) {
        List<TopicPartition> partitions = new ArrayList<>();
        for (String topic : topics) {
            List<PartitionInfo> found = consumer.partitionsFor(topic);
            if (found == null || found.isEmpty()) {
                throw new UnknownTopicOrPartitionException("there is no topic " + topic + " yet");
            }
            found.forEach(each -> partitions.add(new TopicPartition(topic, each.partition())));
        }
        return partitions;
    }

    /** Processes records; returns the answers to pending requests among them. */
    private Map<PendingReplies.Key, CommandResult> take(ConsumerRecords<String, byte[]> records) {
        Map<PendingReplies.Key, CommandResult> fresh = new HashMap<>();
        for (ConsumerRecord<String, byte[]> record : records) {
            if (MANAGERS.contains(record.topic())) {
                takeAnswer(record, fresh);
            } else {
                takeValue(record);
            }
        }
        return fresh;
    }

    private void takeAnswer(ConsumerRecord<String, byte[]> record, Map<PendingReplies.Key, CommandResult> fresh) {
        CommandResult answer;
        try {
            answer = CommandResult.read(record.value() == null ? new byte[0] : record.value());
        } catch (UnreadableException e) { // a request, or a record of another program
            return;
        }
        if (view.isComplete()) {
            answers.count(record.topic(), answer.outcome());
        }
        answer.requestId().ifPresent(id -> {
            PendingReplies.Key key = new PendingReplies.Key(record.topic(), id);
            String fingerprint =
                    KafkaClients.text(record.headers(), RequestFingerprint.HEADER); // null without a header
            answers.cache(key, fingerprint, record.value(), answer);
            if (answers.isPending(key, fingerprint)) {
                fresh.put(key, answer);
            }
        });
    }

    private void takeValue(ConsumerRecord<String, byte[]> record) {
        try {
            boolean object = record.value() != null && NgsiJson.read(record.value()) instanceof ObjectNode;
            byte[] value = object ? record.value() : null;
            if (!record.topic().equals(Topics.AUDIT)) {
                view.put(record.topic(), record.key() == null ? "" : record.key(), value);
            } else if (value != null) {
                view.audit(record.offset(), value);
            }
        } catch (UnreadableException e) { // managers and hosts never write this
            LOG.debug("{} is not JSON", KafkaClients.position(record), e);
        }
    }

    @Override
    public void close() {
        closing.countDown();
        Consumer<String, byte[]> current = consumer;
        if (current != null) {
            current.wakeup();
        }
        try {
            thread.join(TimeUnit.SECONDS.toMillis(TIMEOUT_SECONDS));
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
