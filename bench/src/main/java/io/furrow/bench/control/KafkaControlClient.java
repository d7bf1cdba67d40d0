package io.furrow.bench.control;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.LongAdder;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringDeserializer;
import org.apache.kafka.common.serialization.StringSerializer;

import io.furrow.model.control.CommandResult;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Writes requests to the topics of the managers, and reads the answers that are committed there. */
public final class KafkaControlClient implements ControlClient {
    private static final Duration POLL = Duration.ofMillis(50);

    private final Map<String, CompletableFuture<String>> waiting = new ConcurrentHashMap<>();
    private final LongAdder repeats = new LongAdder();
    private final CountDownLatch closing = new CountDownLatch(1);
    private final KafkaProducer<String, byte[]> producer;
    private final KafkaConsumer<String, byte[]> consumer;
    private final Thread reader = new Thread(this::read, "answers");

    public KafkaControlClient(Properties kafka) {
        Properties settings = new Properties();
        settings.putAll(kafka);
        settings.put("isolation.level", "read_committed");
        producer = new KafkaProducer<>(settings, new StringSerializer(), new ByteArraySerializer());
        consumer = new KafkaConsumer<>(settings, new StringDeserializer(), new ByteArrayDeserializer());
        List<TopicPartition> partitions = new ArrayList<>();
        for (String topic : List.of(Topics.DOMAIN_MANAGER, Topics.MISSION_MANAGER)) {
            consumer.partitionsFor(topic).forEach(each -> partitions.add(new TopicPartition(topic, each.partition())));
        }
        consumer.assign(partitions);
        consumer.seekToEnd(partitions);
        partitions.forEach(consumer::position);
        reader.setDaemon(true);
        reader.start();
    }

    @Override
    public CompletableFuture<String> ask(ControlRequest request, String id) {
        CompletableFuture<String> answer = new CompletableFuture<>();
        waiting.put(id, answer);
        producer.send(new ProducerRecord<>(request.topic(), id, NgsiJson.write(request.record(id))));
        return answer;
    }

    private void read() {
        while (closing.getCount() > 0) {
            for (ConsumerRecord<String, byte[]> record : consumer.poll(POLL)) {
                try {
                    CommandResult response = CommandResult.read(record.value());
                    CompletableFuture<String> answer =
                            waiting.remove(response.requestId().orElse(""));
                    if (answer == null) {
                        repeats.increment();
                    } else {
                        answer.complete(response.status());
                    }
                } catch (UnreadableException e) { // a request: those are on the topic too
                    continue;
                }
            }
        }
    }

    @Override
    public long repeats() {
        return repeats.sum();
    }

    @Override
    public void close() {
        closing.countDown();
        try {
            reader.join(TimeUnit.SECONDS.toMillis(5));
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
        consumer.close();
        producer.close();
    }
}
