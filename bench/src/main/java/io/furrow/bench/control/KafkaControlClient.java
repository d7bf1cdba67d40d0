package io.furrow.bench.control;

import java.util.Map;
import java.util.Properties;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.LongAdder;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;

import io.furrow.bench.frame.TopicReader;
import io.furrow.model.control.CommandResult;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** Writes requests to the topics of the managers, and reads the committed answers there. */
final class KafkaControlClient implements ControlClient {
    private final Map<String, CompletableFuture<String>> waiting = new ConcurrentHashMap<>();
    private final LongAdder repeats = new LongAdder();
    private final KafkaProducer<String, byte[]> producer;
    private final TopicReader reader;

    KafkaControlClient(Properties kafka) {
        producer = new KafkaProducer<>(kafka, new StringSerializer(), new ByteArraySerializer());
        reader = TopicReader.fromEnd(kafka, TopicReader.COMMITTED, Topics.DOMAIN_MANAGER, Topics.MISSION_MANAGER)
                .follow(records -> records.forEach(this::take));
    }

    @Override
    public CompletableFuture<String> ask(ControlRequest request, String id) {
        CompletableFuture<String> answer = new CompletableFuture<>();
        waiting.put(id, answer);
        producer.send(new ProducerRecord<>(request.topic(), id, NgsiJson.write(request.record(id))));
        return answer;
    }

    private void take(ConsumerRecord<byte[], byte[]> record) {
        CommandResult response;
        try {
            response = CommandResult.read(record.value());
        } catch (UnreadableException e) { // a request: those are on the topic too
            return;
        }
        CompletableFuture<String> answer = waiting.remove(response.requestId().orElse(""));
        if (answer == null) {
            repeats.increment();
        } else {
            answer.complete(response.status());
        }
    }

    @Override
    public long repeats() {
        return repeats.sum();
    }

    @Override
    public void close() {
        reader.close();
        producer.close();
    }
}
