package io.furrow.soak;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.BitSet;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.Set;
import java.util.TreeMap;

import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;

import io.furrow.control.letter.Redrive;
import io.furrow.embedded.EmbeddedFlink;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.files.Folders;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.job.JobOptions;
import io.furrow.ingest.IngestJob;
import io.furrow.ingest.IngestOptions;
import io.furrow.ingest.normalize.NormalizeJob;
import io.furrow.ingest.normalize.NormalizeOptions;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * Sends bad records of every kind among good ones through {@code normalize} and {@code ingest}, on a separate Kafka and
 * Flink: every good event must be written once, every bad record must become a dead letter with its reason and its
 * bytes.
 */
public final class BadAmongGood implements AutoCloseable {
    private static final String KIND = "kind";
    private static final String OUT = Topics.realtime("soak");
    private static final long TIME = 1_700_000_000_000L;
    private static final int ENTITIES = 1000;
    private static final int PARTITIONS = 4;
    private static final int SLOTS = 2;
    private static final List<String> DEAD = List.of(Topics.dead(Topics.NOTIFICATIONS), Topics.dead(Topics.RAW));

    private final EmbeddedKafka kafka;
    private final EmbeddedFlink flink;
    private final List<BadRecord> kinds = BadRecord.all();

    private BadAmongGood(EmbeddedKafka kafka, EmbeddedFlink flink) {
        this.kafka = kafka;
        this.flink = flink;
    }

    static BadAmongGood start(Path directory) throws Exception {
        EmbeddedKafka kafka = EmbeddedKafka.start(directory.resolve("kafka"));
        BadAmongGood run = new BadAmongGood(kafka, EmbeddedFlink.start(SLOTS, 0));
        List<String> topics = new ArrayList<>(List.of(Topics.NOTIFICATIONS, Topics.RAW, OUT));
        topics.addAll(DEAD);
        kafka.createTopics(topics.stream().map(BadAmongGood::topic).toList());
        run.submit(new NormalizeOptions(), directory.resolve("normalize"));
        run.submit(new IngestOptions(), directory.resolve("ingest"));
        return run;
    }

    /** Retains records of any time, because retention depends on the record timestamp. */
    private static NewTopic topic(String name) {
        return new NewTopic(name, Optional.of(PARTITIONS), Optional.empty()).configs(Map.of("retention.ms", "-1"));
    }

    /** Arguments: number of good and of bad records. The exit code is 0 if there are no faults. */
    public static void main(String... args) throws Exception {
        int good = Integer.parseInt(args[0]);
        int bad = Integer.parseInt(args[1]);
        Path directory = Files.createTempDirectory("furrow-bad-records-");
        List<String> faults;
        try (BadAmongGood run = start(directory)) {
            run.write(good, bad);
            System.out.printf("wrote %d good and %d bad records of %d kinds%n", good, bad, run.kinds.size());
            faults = run.faults(good, bad, Duration.ofMinutes(20));
            faults.addAll(run.faultsAfterRedrive(good, bad, Duration.ofMinutes(5)));
        } finally {
            Folders.delete(directory);
        }
        faults.forEach(System.out::println);
        System.exit(faults.isEmpty() ? 0 : 1);
    }

    private void submit(JobOptions options, Path checkpoints) {
        JobCommandLine.of(options)
                .parseArgs(
                        "--bootstrap-servers",
                        kafka.bootstrapServers(),
                        "--checkpoint-interval",
                        "5s",
                        "--checkpoint-dir",
                        checkpoints.toUri().toString(),
                        "--parallelism",
                        "1");
        StreamExecutionEnvironment env = options instanceof IngestOptions ingest
                ? IngestJob.assemble(ingest)
                : NormalizeJob.assemble((NormalizeOptions) options);
        flink.submit(env.getStreamGraph());
    }

    /**
     * Writes good and bad records in turn; half of the good ones as native notifications, half as records of {@code
     * data.raw}.
     */
    void write(int good, int bad) {
        Map<String, Object> settings = new HashMap<>(kafka.producerSettings());
        settings.put("linger.ms", "20");
        settings.put("batch.size", "262144");
        try (var producer = new KafkaProducer<>(settings, new ByteArraySerializer(), new ByteArraySerializer())) {
            int written = 0;
            for (int number = 0; number < good; number++) {
                producer.send(good(number));
                for (; (long) written * good < (long) bad * (number + 1); written++) {
                    producer.send(bad(kinds.get(written % kinds.size())));
                }
            }
        }
    }

    private static ProducerRecord<byte[], byte[]> good(int number) {
        boolean notification = number % 2 == 0;
        String id = "good-" + number % ENTITIES;
        String value = notification
                ? "{\"subscriptionId\":\"s\",\"data\":[{\"id\":\"%s\",\"type\":\"T\",\"Domain\":\"soak\",\"Time\":%d,\"n\":%d}]}"
                        .formatted(id, TIME + number, number)
                : ("{\"id\":\"%s\",\"type\":\"T\",\"Domain\":{\"type\":\"Text\",\"value\":\"soak\",\"metadata\":{}},"
                                + "\"n\":{\"type\":\"Number\",\"value\":%d,\"metadata\":{}}}")
                        .formatted(id, number);
        return new ProducerRecord<>(
                notification ? Topics.NOTIFICATIONS : Topics.RAW,
                null,
                TIME + number,
                id.getBytes(UTF_8),
                value.getBytes(UTF_8));
    }

    private static ProducerRecord<byte[], byte[]> bad(BadRecord kind) {
        var record = new ProducerRecord<>(kind.topic(), null, TIME, kind.key(), kind.value());
        record.headers().add(KIND, kind.kind().getBytes(UTF_8));
        return record;
    }

    /** Waits for missing events and returns the faults as sentences. */
    List<String> faults(int good, int bad, Duration timeout) {
        long until = System.nanoTime() + timeout.toNanos();
        List<String> faults = new ArrayList<>();
        BitSet seen = new BitSet(good);
        long repeated = 0;
        try (var consumer = consumer(List.of(OUT))) {
            long read = 0;
            while (seen.cardinality() < good && System.nanoTime() < until) {
                for (ConsumerRecord<byte[], byte[]> record : consumer.poll(Duration.ofMillis(500))) {
                    int number = (int) (record.timestamp() - TIME);
                    repeated += seen.get(number) ? 1 : 0;
                    seen.set(number);
                    read++;
                }
            }
            System.out.printf("%d records were emitted, %d different events%n", read, seen.cardinality());
        }
        if (seen.cardinality() != good || repeated > 0) {
            faults.add("of " + good + " good events " + (good - seen.cardinality()) + " were not emitted, " + repeated
                    + " were emitted more than once");
        }
        faults.addAll(wrongDeadLetters(bad, 1, until));
        return faults;
    }

    /**
     * Redrives the dead letters without a repair: each must become the same dead letter again, and no good event may be
     * written twice.
     */
    List<String> faultsAfterRedrive(int good, int bad, Duration timeout) throws IOException {
        long until = System.nanoTime() + timeout.toNanos();
        Properties kafkaProperties = new Properties();
        kafkaProperties.putAll(client());
        List<String> faults = new ArrayList<>();
        long redriven = 0;
        for (String topic : DEAD) {
            String origin = Topics.ofDeadLetters(topic).orElseThrow();
            Redrive.Choice all = new Redrive.Choice(Set.of(), Set.of());
            Redrive.Outcome outcome;
            do {
                outcome = new Redrive(kafkaProperties, new Redrive.Request(topic, origin, all, false, false)).run();
                redriven += outcome.total();
            } while (!outcome.isComplete());
        }
        System.out.printf("%d dead letters were brought back%n", redriven);
        if (redriven != bad) {
            faults.add(redriven + " dead letters were brought back instead of " + bad);
        }
        faults.addAll(wrongDeadLetters(bad, 2, until));
        try (var consumer = consumer(List.of(OUT))) {
            long written = consumer.endOffsets(consumer.assignment()).values().stream()
                    .mapToLong(Long::longValue)
                    .sum();
            if (written != good) {
                faults.add(written + " records are out instead of " + good);
            }
        }
        return faults;
    }

    /** @param times how often each bad record should have become a dead letter */
    private List<String> wrongDeadLetters(int bad, int times, long until) {
        Map<String, Integer> deadLetters = new TreeMap<>();
        List<String> faults = new ArrayList<>();
        int read = 0;
        try (var consumer = consumer(DEAD)) {
            while (read < bad * times && System.nanoTime() < until) {
                for (ConsumerRecord<byte[], byte[]> deadLetter : consumer.poll(Duration.ofMillis(500))) {
                    read++;
                    deadLetters.merge(header(deadLetter, KIND), 1, Integer::sum);
                    fault(deadLetter).ifPresent(faults::add);
                }
            }
        }
        for (int i = 0; i < kinds.size(); i++) {
            int expected = times * (bad / kinds.size() + (i < bad % kinds.size() ? 1 : 0));
            int found = deadLetters.getOrDefault(kinds.get(i).kind(), 0);
            System.out.printf(
                    "%6d %-16s %s%n", found, kinds.get(i).reason(), kinds.get(i).kind());
            if (found != expected) {
                faults.add(found + " dead letters instead of " + expected + ": "
                        + kinds.get(i).kind());
            }
        }
        return faults;
    }

    private Optional<String> fault(ConsumerRecord<byte[], byte[]> deadLetter) {
        Optional<BadRecord> kind = kinds.stream()
                .filter(each -> each.kind().equals(header(deadLetter, KIND)))
                .findFirst();
        if (kind.isEmpty()) {
            return Optional.of("a good record was set aside: " + header(deadLetter, DeadLetter.MESSAGE));
        }
        boolean asExpected =
                header(deadLetter, DeadLetter.REASON).equals(kind.get().reason())
                        && deadLetter.topic().equals(Topics.dead(kind.get().topic()));
        // Each bad entity of a notification with several entities becomes a separate dead letter.
        boolean whole = Arrays.equals(deadLetter.value(), kind.get().value())
                || new String(kind.get().value(), UTF_8).contains(new String(deadLetter.value(), UTF_8));
        return asExpected && whole
                ? Optional.empty()
                : Optional.of(kind.get().kind() + " became " + header(deadLetter, DeadLetter.REASON) + " on "
                        + deadLetter.topic());
    }

    private KafkaConsumer<byte[], byte[]> consumer(List<String> topics) {
        Map<String, Object> settings = new HashMap<>(client());
        settings.put("auto.offset.reset", "earliest");
        settings.put("isolation.level", "read_committed");
        var consumer = new KafkaConsumer<>(settings, new ByteArrayDeserializer(), new ByteArrayDeserializer());
        consumer.assign(topics.stream()
                .flatMap(topic -> consumer.partitionsFor(topic).stream())
                .map(info -> new TopicPartition(info.topic(), info.partition()))
                .toList());
        return consumer;
    }

    private Map<String, Object> client() {
        return Map.of("bootstrap.servers", kafka.bootstrapServers());
    }

    private static String header(ConsumerRecord<byte[], byte[]> record, String name) {
        Header header = record.headers().lastHeader(name);
        return header == null ? "" : new String(header.value(), UTF_8);
    }

    @Override
    public void close() {
        flink.close();
        kafka.close();
    }
}
