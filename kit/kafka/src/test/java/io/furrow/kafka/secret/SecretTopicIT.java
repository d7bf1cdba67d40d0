package io.furrow.kafka.secret;

import java.io.IOException;
import java.nio.file.Path;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CyclicBarrier;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.stream.Stream;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestInstance;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

@TestInstance(TestInstance.Lifecycle.PER_CLASS)
@Tag("full")
class SecretTopicIT {
    private static final Instant NOW = Instant.parse("2026-03-01T08:00:00Z");

    private final FarmSecret first = FarmSecret.generate();
    private final FarmSecret second = first.rotated(NOW, NOW.plusSeconds(60), false);

    @AutoClose
    private EmbeddedKafka kafka;

    @BeforeAll
    void start(@TempDir Path directory) throws IOException {
        kafka = EmbeddedKafka.start(directory.resolve("kafka"));
    }

    @BeforeEach
    void makeAFarmWithoutASecret() throws Exception {
        try (Admin admin = Admin.create(kafka.client())) {
            if (admin.listTopics().names().get().contains(Topics.SECRETS)) {
                admin.deleteTopics(List.of(Topics.SECRETS)).all().get();
                await().until(() -> !admin.listTopics().names().get().contains(Topics.SECRETS));
            }
        }
        kafka.createTopics(
                List.of(new NewTopic(Topics.SECRETS, 1, (short) 1).configs(Map.of("cleanup.policy", "compact"))));
    }

    @Test
    void takesTheFirstSecretAndRefusesAnotherSayingWhatToDo() throws Exception {
        FarmSecret another = FarmSecret.generate();
        topic(null).claim(first);
        topic(null).claim(first);

        assertThatThrownBy(() -> topic(null).claim(another))
                .isInstanceOf(IOException.class)
                .hasMessageContainingAll(
                        "this farm has another secret",
                        first.toString(),
                        another.toString(),
                        "--replace-farm-secret " + first.fingerprint());
        topic(null).claim(first);
    }

    @Test
    void followsARotationAndRefusesTheSecretFromBefore() throws Exception {
        topic(null).claim(first);
        topic(null).claim(second);

        assertThatThrownBy(() -> topic(null).claim(first))
                .isInstanceOf(IOException.class)
                .hasMessageContainingAll("was rotated", second.toString(), "copy of the newest file");
        assertThatThrownBy(() -> topic(null).claim(first.rotated(NOW, NOW, false)))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("another secret");
    }

    @Test
    void takesAnotherSecretOnlyInThePlaceOfTheOneThatIsNamed() throws Exception {
        FarmSecret another = FarmSecret.generate();
        topic(null).claim(first);
        assertThatThrownBy(() -> topic(another.fingerprint()).claim(another)).isInstanceOf(IOException.class);

        topic(first.fingerprint()).claim(another);

        // Who still names it does not take it back.
        assertThatThrownBy(() -> topic(null).claim(first)).isInstanceOf(IOException.class);
        topic(first.fingerprint()).claim(another);
    }

    /** Of processes that start at once on a new farm, each with a secret of its own, one wins and all others are told. */
    @Test
    void letsExactlyOneOfSeveralWin() throws Exception {
        List<FarmSecret> secrets =
                Stream.generate(FarmSecret::generate).limit(4).toList();
        List<Boolean> taken = atOnce(secrets);

        assertThat(taken).containsOnlyOnce(true);
        topic(null).claim(secrets.get(taken.indexOf(true)));
    }

    /** Instances of one control plane are started at once, and none may give up. */
    @Test
    void takesTheSameSecretFromSeveralAtOnce() throws Exception {
        for (int round = 0; round < 10; round++) {
            makeAFarmWithoutASecret();
            assertThat(atOnce(Collections.nCopies(6, first))).hasSize(6).containsOnly(true);
        }
    }

    /** Which of the secrets were taken when as many processes claimed them together. */
    private List<Boolean> atOnce(List<FarmSecret> secrets) throws Exception {
        CyclicBarrier together = new CyclicBarrier(secrets.size());
        ExecutorService threads = Executors.newFixedThreadPool(secrets.size());
        List<Future<Boolean>> outcomes = new ArrayList<>();
        for (FarmSecret secret : secrets) {
            outcomes.add(threads.submit(() -> {
                together.await();
                return isTaken(secret);
            }));
        }
        List<Boolean> taken = new ArrayList<>();
        for (Future<Boolean> outcome : outcomes) {
            taken.add(outcome.get());
        }
        threads.shutdown();
        return taken;
    }

    private boolean isTaken(FarmSecret secret) throws IOException {
        try {
            topic(null).claim(secret);
            return true;
        } catch (IOException e) {
            if (!e.getMessage().contains("this farm has another secret")) {
                throw e;
            }
            return false;
        }
    }

    private SecretTopic topic(String replaced) {
        return new SecretTopic(kafka.client(), replaced);
    }
}
