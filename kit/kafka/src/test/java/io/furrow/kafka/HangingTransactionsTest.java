package io.furrow.kafka;

import java.io.IOException;
import java.lang.reflect.Proxy;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.time.Duration;
import java.util.List;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.stream.Stream;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.ListTransactionsOptions;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.admin.TransactionState;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.TopicPartition;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedKafka;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

class HangingTransactionsTest {
    private static final TopicPartition PARTITION = new TopicPartition("states", 0);

    @TempDir
    Path folder;

    @Test
    void abortsOnlyATransactionWhoseEndAPowerCutTook() throws Exception {
        Path cut = writeAndCutPower();

        try (EmbeddedKafka kafka = EmbeddedKafka.start(cut);
                Admin admin = Admin.create(kafka.client());
                KafkaProducer<String, byte[]> producer = producer(kafka, "next");
                KafkaConsumer<String, byte[]> consumer = consumer(kafka)) {
            send(producer, "after");
            producer.commitTransaction();
            assertThat(read(consumer)).isEmpty();

            send(producer, "ongoing");
            assertThat(HangingTransactions.abort(withLoadingCoordinators(admin)))
                    .isEqualTo(1);
            producer.commitTransaction();

            await().untilAsserted(() -> assertThat(read(consumer)).isEqualTo(List.of("after", "ongoing")));
            assertThat(HangingTransactions.abort(admin)).isZero();
        }
    }

    /** Coordinators that list no transaction before they have described one, which they do as soon as they have loaded their log. */
    private static Admin withLoadingCoordinators(Admin admin) {
        AtomicBoolean loaded = new AtomicBoolean();
        return (Admin) Proxy.newProxyInstance(
                Admin.class.getClassLoader(), new Class<?>[] {Admin.class}, (proxy, method, arguments) -> {
                    if (method.getName().equals("listTransactions") && !loaded.get()) {
                        return admin.listTransactions(new ListTransactionsOptions().filterProducerIds(Set.of(-1L)));
                    }
                    if (method.getName().equals("describeTransactions")) {
                        loaded.set(true);
                    }
                    return method.invoke(admin, arguments);
                });
    }

    /** @return the files of a broker whose partition has the transaction's record, but not its end, which the coordinator knows */
    private Path writeAndCutPower() throws Exception {
        Path data = folder.resolve("kafka");
        Path cut = folder.resolve("cut");
        try (EmbeddedKafka kafka = EmbeddedKafka.start(data);
                Admin admin = Admin.create(kafka.client());
                KafkaProducer<String, byte[]> producer = producer(kafka, "lost")) {
            kafka.createTopics(List.of(new NewTopic(PARTITION.topic(), 1, (short) 1)));
            send(producer, "before");
            copy(data.resolve(PARTITION.toString()), folder.resolve("earlier"));
            producer.commitTransaction();
            await().until(() -> admin.listTransactions().all().get().stream()
                    .allMatch(each -> each.state() == TransactionState.COMPLETE_COMMIT));
            copy(data, cut);
        }
        copy(folder.resolve("earlier"), cut.resolve(PARTITION.toString()));
        return cut;
    }

    private static KafkaProducer<String, byte[]> producer(EmbeddedKafka kafka, String id) {
        Properties settings = kafka.client();
        settings.setProperty("transactional.id", id);
        KafkaProducer<String, byte[]> producer = KafkaClients.producer(settings);
        producer.initTransactions();
        return producer;
    }

    private static void send(KafkaProducer<String, byte[]> producer, String key) {
        producer.beginTransaction();
        producer.send(new ProducerRecord<>(PARTITION.topic(), key, new byte[0]));
        producer.flush();
    }

    private static KafkaConsumer<String, byte[]> consumer(EmbeddedKafka kafka) {
        Properties settings = kafka.client();
        settings.setProperty("isolation.level", "read_committed");
        KafkaConsumer<String, byte[]> consumer = KafkaClients.consumer(settings);
        consumer.assign(List.of(PARTITION));
        return consumer;
    }

    private static List<String> read(KafkaConsumer<String, byte[]> consumer) {
        consumer.seekToBeginning(List.of(PARTITION));
        return Stream.of(consumer.poll(Duration.ofSeconds(2)))
                .flatMap(records -> records.records(PARTITION).stream())
                .map(record -> record.key())
                .toList();
    }

    private static void copy(Path from, Path to) throws IOException {
        try (Stream<Path> files = Files.walk(from)) {
            for (Path file : files.toList()) {
                Path target = to.resolve(from.relativize(file));
                if (Files.isDirectory(file)) {
                    Files.createDirectories(target);
                } else {
                    Files.copy(file, target, StandardCopyOption.REPLACE_EXISTING);
                }
            }
        }
    }
}
