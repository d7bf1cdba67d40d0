package io.furrow.soak.replay;

import static java.nio.charset.StandardCharsets.UTF_8;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Random;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;

import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.soak.replay.PlayedEpochs.Entry;

/** Reads the topics of all steered replays and says what is wrong with them. */
public final class PlayedTopics {
    private static final int SHOWN = 20;

    private final String bootstrapServers;
    private final String plant;
    private final Random random;

    private PlayedTopics(String bootstrapServers, String plant, long seed) {
        this.bootstrapServers = bootstrapServers;
        this.plant = plant;
        this.random = new Random(seed);
    }

    /**
     * Arguments: bootstrap servers, at-least-once or exactly-once, number of replays, what to plant (none, lost, doubled), seed. The exit
     * code is 0 where nothing is wrong.
     */
    public static void main(String... args) throws UnreadableException {
        PlayedTopics topics = new PlayedTopics(args[0], args[3], Long.parseLong(args[4]));
        boolean exactlyOnce = args[1].equals("exactly-once");
        int wrong = 0;
        for (int i = 0; i < Integer.parseInt(args[2]); i++) {
            wrong += topics.check(SteeredReplay.topic(i), exactlyOnce);
        }
        System.exit(wrong == 0 ? 0 : 1);
    }

    private int check(String topic, boolean exactlyOnce) throws UnreadableException {
        List<ConsumerRecord<byte[], byte[]>> records = records(topic);
        plant(records);
        PlayedEpochs epochs = new PlayedEpochs();
        int partitions = 0;
        for (ConsumerRecord<byte[], byte[]> record : records) {
            partitions = Math.max(partitions, record.partition() + 1);
            epochs.add(
                    number(record, HeaderNames.REPLAY_EPOCH),
                    number(record, HeaderNames.REPLAY_SEQUENCE),
                    entry(record));
        }
        List<String> faults = new ArrayList<>(epochs.gaps());
        faults.addAll(epochs.changed());
        if (exactlyOnce) {
            faults.addAll(epochs.faultsOfExactlyOnce(partitions));
        }
        System.out.printf(
                "%s: %d epochs, %d records, %d sequences more than once, %d faults%n",
                topic, epochs.count(), epochs.records(), epochs.doubled(), faults.size());
        faults.stream().limit(SHOWN).forEach(fault -> System.out.println("    " + fault));
        return faults.size() + (records.isEmpty() ? 1 : 0);
    }

    /** As if one of the records were not there, or twice. */
    private void plant(List<ConsumerRecord<byte[], byte[]>> records) {
        if (plant.equals("none")) {
            return;
        }
        int index = random.nextInt(records.size());
        while (!header(records.get(index), HeaderNames.REPLAY_KIND).equals("event")) {
            index = random.nextInt(records.size());
        }
        if (plant.equals("lost")) {
            records.remove(index);
        } else {
            records.add(records.get(index));
        }
    }

    private static Entry entry(ConsumerRecord<byte[], byte[]> record) throws UnreadableException {
        String kind = header(record, HeaderNames.REPLAY_KIND);
        long number = kind.equals("event")
                ? NgsiJson.read(record.value())
                        .path(SteeredReplay.NUMBER)
                        .path("value")
                        .asLong()
                : -1;
        return new Entry(kind, record.partition(), number);
    }

    private static long number(ConsumerRecord<byte[], byte[]> record, String name) {
        return Long.parseLong(header(record, name));
    }

    private static String header(ConsumerRecord<byte[], byte[]> record, String name) {
        return new String(record.headers().lastHeader(name).value(), UTF_8);
    }

    private List<ConsumerRecord<byte[], byte[]>> records(String topic) {
        Map<String, Object> settings = Map.of(
                "bootstrap.servers", bootstrapServers,
                "isolation.level", "read_committed",
                "allow.auto.create.topics", "false");
        List<ConsumerRecord<byte[], byte[]>> records = new ArrayList<>();
        try (var consumer = new KafkaConsumer<>(settings, new ByteArrayDeserializer(), new ByteArrayDeserializer())) {
            List<TopicPartition> partitions = consumer.partitionsFor(topic).stream()
                    .map(info -> new TopicPartition(topic, info.partition()))
                    .toList();
            consumer.assign(partitions);
            consumer.seekToBeginning(partitions);
            Map<TopicPartition, Long> ends = consumer.endOffsets(partitions);
            while (ends.entrySet().stream().anyMatch(end -> consumer.position(end.getKey()) < end.getValue())) {
                consumer.poll(Duration.ofMillis(100)).forEach(records::add);
            }
        }
        return records;
    }
}
