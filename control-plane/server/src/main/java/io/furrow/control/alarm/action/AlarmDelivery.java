package io.furrow.control.alarm.action;

import java.io.UncheckedIOException;
import java.time.Clock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.Map;
import java.util.Objects;
import java.util.Optional;
import java.util.Properties;
import java.util.Random;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.TimeUnit;

import org.apache.kafka.clients.consumer.ConsumerRebalanceListener;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.alarm.Alarm;
import io.furrow.control.alarm.AlarmState;
import io.furrow.kafka.CommittedReader;
import io.furrow.kafka.KafkaClients;
import io.furrow.kafka.SupervisedWorker;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.Topics;

/**
 * Delivers the alarms of {@code service.alarms} to the webhook. A consumer group elects the delivering instance. It
 * reads the alarms and the deliveries in {@code service.alarms.delivered} from the beginning, posts the difference, and
 * then follows the topic. No offset is committed, so that no alarm on the topic is lost over restarts and failures.
 */
final class AlarmDelivery implements SupervisedWorker.Work, ConsumerRebalanceListener {
    static final String NAME = "webhook";

    private static final Logger LOG = LoggerFactory.getLogger(AlarmDelivery.class);
    private static final String GROUP = "furrow-alarm-webhook";
    private static final Duration POLL = Duration.ofMillis(200);
    private static final Duration POLL_IN_FLIGHT = Duration.ofMillis(10);
    private static final long DECIDED_EVERY_MS = Duration.ofSeconds(30).toMillis();
    private static final long LAST_ANSWERS_MS = 1000;
    /** Key of the record with the start time: alarms that were closed earlier and never delivered are not delivered. */
    private static final String SINCE = "";

    private static final Duration MAX_AGE_AT_FIRST_START = Duration.ofMinutes(10);

    private final Properties client;
    private final Webhook.Settings settings;
    private final Webhook webhook;
    private final Clock clock;
    private final BlockingQueue<Done> done = new LinkedBlockingQueue<>();
    private KafkaConsumer<String, byte[]> consumer;
    private KafkaProducer<String, byte[]> producer;
    /** Null while another instance delivers. */
    private DeliveryQueue queue;

    private Map<TopicPartition, Long> unread = Map.of();
    private long decided;
    private long accepted;
    private long rejected;
    private volatile String detail = "starts";

    private record Done(DeliveryQueue.Post post, Webhook.Answer answer) {}

    AlarmDelivery(Properties client, Webhook.Settings settings, Webhook webhook, Clock clock) {
        this.client = client;
        this.settings = settings;
        this.webhook = webhook;
        this.clock = clock;
    }

    /** Detail of the status. */
    String detail() {
        return detail;
    }

    @Override
    public void run(SupervisedWorker worker) throws InterruptedException {
        Properties group = CommittedReader.settings(client);
        group.put("group.id", GROUP);
        try (KafkaProducer<String, byte[]> opened = KafkaClients.producer(client);
                KafkaConsumer<String, byte[]> subscribed = KafkaClients.consumer(group)) {
            producer = opened;
            consumer = subscribed;
            consumer.subscribe(List.of(Topics.ALARMS), this);
            while (!worker.isClosing()) {
                step(worker);
            }
            awaitAnswers(worker);
        } finally {
            queue = null;
            Thread.interrupted(); // else the clients could not close cleanly
        }
    }

    private void step(SupervisedWorker worker) throws InterruptedException {
        boolean busy = queue != null && queue.inFlight() > 0;
        for (ConsumerRecord<String, byte[]> record : consumer.poll(busy ? POLL_IN_FLIGHT : POLL)) {
            take(record);
        }
        if (queue == null) {
            detail = "another instance delivers";
            return;
        }
        complete(worker, done.poll(busy ? POLL_IN_FLIGHT.toMillis() : 0, TimeUnit.MILLISECONDS));
        List<Done> more = new ArrayList<>();
        done.drainTo(more);
        more.forEach(each -> complete(worker, each));
        if (isCaughtUp()) {
            post();
        }
        detail = "%d waiting, %d in flight, since the start %d accepted and %d rejected"
                .formatted(queue.waiting(), queue.inFlight(), accepted, rejected);
    }

    private void post() {
        long now = clock.millis();
        if (now - decided >= DECIDED_EVERY_MS) {
            decided = now;
            queue.passTime(now);
        }
        List<DeliveryQueue.Post> posts = new ArrayList<>();
        for (Optional<DeliveryQueue.Post> next = queue.next(now); next.isPresent(); next = queue.next(now)) {
            posts.add(next.get());
        }
        List<DeliveryQueue.Update> attempts = posts.stream()
                .map(DeliveryQueue.Post::attempt)
                .filter(Objects::nonNull)
                .toList();
        if (!attempts.isEmpty()) {
            attempts.forEach(this::store);
            producer.flush();
        }
        posts.forEach(this::post);
    }

    private void post(DeliveryQueue.Post post) {
        try {
            webhook.post(post.id(), post.alarm()).thenAccept(answer -> done.add(new Done(post, answer)));
        } catch (RuntimeException e) { // an alarm that cannot be posted must not block the others
            done.add(new Done(post, Webhook.Answer.failed(FailureText.of(e))));
        }
    }

    private void take(ConsumerRecord<String, byte[]> record) {
        try {
            if (record.value() == null) {
                if (queue.isWaiting(record.key())) {
                    LOG.error(
                            "alarm {} was closed long ago and is dropped: the webhook never accepted it", record.key());
                }
                queue.remove(record.key()).ifPresent(this::store);
            } else {
                queue.take(StateJson.read(record.value(), Alarm.class), clock.millis());
            }
        } catch (UncheckedIOException e) {
            LOG.warn("record {} is not an alarm and is skipped", KafkaClients.position(record), e);
        }
    }

    /** @param completed null for nothing */
    private void complete(SupervisedWorker worker, Done completed) {
        if (completed == null) {
            return;
        }
        Webhook.Answer answer = completed.answer();
        Alarm alarm = completed.post().alarm();
        switch (answer.outcome()) {
            case ACCEPTED -> {
                accepted++;
                worker.succeeded();
            }
            case REJECTED -> {
                rejected++;
                worker.failed("alarm %s was rejected: %s".formatted(alarm.alarm(), answer.reason()));
                LOG.error(
                        "the webhook at {} rejected alarm {} ({}), which is not posted again until it changes: {}",
                        settings.url().getHost(),
                        alarm.alarm(),
                        alarm.change().code(),
                        answer.reason());
            }
            case FAILED -> worker.failed("alarm %s: %s".formatted(alarm.alarm(), answer.reason()));
        }
        queue.completed(completed.post(), answer, clock.millis()).ifPresent(this::store);
    }

    private void store(DeliveryQueue.Update update) {
        byte[] value = update.delivered() == null ? null : update.delivered().toBytes();
        producer.send(new ProducerRecord<>(Topics.ALARMS_DELIVERED, update.alarm(), value), (written, failure) -> {
            if (failure != null) {
                LOG.warn("alarm {} may be delivered again after a restart", update.alarm(), failure);
            }
        });
    }

    /** Whether all records that existed when the topic was assigned were read. */
    private boolean isCaughtUp() {
        if (!unread.isEmpty()
                && unread.entrySet().stream().allMatch(end -> consumer.position(end.getKey()) >= end.getValue())) {
            unread = Map.of();
            queue.forgetMissing().forEach(this::store);
            LOG.info("alarms are delivered to {}", settings.url().getHost());
        }
        return unread.isEmpty();
    }

    @Override
    public void onPartitionsAssigned(Collection<TopicPartition> partitions) {
        if (partitions.isEmpty()) {
            return;
        }
        List<ConsumerRecord<String, byte[]>> stored = new ArrayList<>();
        try (CommittedReader<String> delivered = CommittedReader.open(client, Topics.ALARMS_DELIVERED)) {
            delivered.readToEnd(stored::add);
        }
        queue = new DeliveryQueue(settings, since(stored), new Random());
        for (ConsumerRecord<String, byte[]> record : stored) {
            if (!SINCE.equals(record.key())) {
                queue.restore(record.key(), delivered(record));
            }
        }
        unread = consumer.endOffsets(partitions);
        consumer.seekToBeginning(partitions);
    }

    private long since(List<ConsumerRecord<String, byte[]>> stored) {
        for (ConsumerRecord<String, byte[]> record : stored) {
            if (SINCE.equals(record.key()) && record.value() != null) {
                return delivered(record).time();
            }
        }
        long since = clock.millis() - MAX_AGE_AT_FIRST_START.toMillis();
        store(new DeliveryQueue.Update(SINCE, new DeliveryState(0, AlarmState.CLOSED, since, 0, false)));
        return since;
    }

    private static DeliveryState delivered(ConsumerRecord<String, byte[]> record) {
        return record.value() == null ? null : StateJson.read(record.value(), DeliveryState.class);
    }

    @Override
    public void onPartitionsRevoked(Collection<TopicPartition> partitions) {
        if (!partitions.isEmpty()) {
            queue = null;
        }
    }

    /** Waits for outstanding responses, so that those alarms are not posted again after a restart. */
    private void awaitAnswers(SupervisedWorker worker) throws InterruptedException {
        long end = System.nanoTime() + TimeUnit.MILLISECONDS.toNanos(LAST_ANSWERS_MS);
        while (queue != null && queue.inFlight() > 0 && System.nanoTime() < end) {
            complete(worker, done.poll(POLL_IN_FLIGHT.toMillis(), TimeUnit.MILLISECONDS));
        }
    }
}
