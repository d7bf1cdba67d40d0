package io.furrow.control;

import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.Callable;
import java.util.stream.Collectors;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.config.ConfigResource;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.awaitility.Awaitility;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.DomainCommand;
import io.furrow.model.control.DomainDetails;
import io.furrow.model.control.MissionCommand;
import io.furrow.model.control.MissionPlan;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.control.Requests;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

class ControlPlaneIT {
    private static final int GROUPS = 10;
    private static final Instant SOUGHT = Instant.parse("2026-05-01T08:00:00Z");
    private static final int REQUESTS = 100;
    private static final int ANSWERED_BEFORE_THE_KILL = 30;
    private static final int SENT_BEFORE_THE_KILL = 60;
    private static final Duration TIMEOUT = Duration.ofSeconds(90);

    @TempDir
    Path directory;

    private EmbeddedKafka kafka;
    private final List<Process> processes = new ArrayList<>();

    @BeforeEach
    void startKafka() {
        kafka = EmbeddedKafka.start(directory.resolve("kafka"));
    }

    @AfterEach
    void stop() throws Exception {
        for (Process process : processes) {
            process.destroyForcibly().waitFor();
        }
        kafka.close();
    }

    @Test
    void givesEachOfAHundredRequestsOneEffectAndOneAnswerThoughItIsKilledAmongThem() throws Exception {
        Process first = run("first", 0);
        try (KafkaProducer<String, byte[]> producer = producer()) {
            for (int i = 0; i < REQUESTS; i++) {
                create(producer, i);
                create(producer, i); // as a client does that has heard nothing
                if (i == ANSWERED_BEFORE_THE_KILL) {
                    producer.flush();
                    await(() -> answers(Topics.DOMAIN_MANAGER).size() > ANSWERED_BEFORE_THE_KILL);
                } else if (i == SENT_BEFORE_THE_KILL) {
                    producer.flush();
                    first.destroyForcibly().waitFor(); // with requests under way
                    assertThat(answers(Topics.DOMAIN_MANAGER)).hasSizeLessThan(REQUESTS);
                }
            }
            producer.flush();
            run("second", 0); // knows nothing but what is in Kafka
            await(() -> answers(Topics.DOMAIN_MANAGER).size() >= REQUESTS);

            // Whatever was answered twice would be answered by then.
            producer.send(new ProducerRecord<>(
                    Topics.DOMAIN_MANAGER, Requests.write("last", new DomainCommand.Delete("nosuch", false))));
            producer.flush();
            await(() -> answers(Topics.DOMAIN_MANAGER).size() > REQUESTS);
        }

        List<CommandResult> answers = answers(Topics.DOMAIN_MANAGER);
        Set<String> ids = new HashSet<>();
        answers.forEach(answer -> ids.add(answer.requestId().orElseThrow()));
        assertThat(answers).hasSize(REQUESTS + 1);
        assertThat(ids).hasSize(REQUESTS + 1);
        assertThat(answers.stream().filter(answer -> answer.status().equals("created")))
                .hasSize(REQUESTS);
        assertThat(records(Topics.DOMAINS)).hasSize(REQUESTS);
    }

    /** Domains are one task and replays another: whichever of two instances is killed, it had one of them. */
    @Tag("full")
    @Test
    void takesOverFromAnInstanceThatIsKilledWithRequestsUnderWay() throws Exception {
        Process first = run("first", 1);
        run("second", 1);
        try (KafkaProducer<String, byte[]> producer = producer()) {
            for (int i = 0; i < REQUESTS / 2; i++) {
                create(producer, i);
                replay(producer, i);
                if (i == ANSWERED_BEFORE_THE_KILL / 2) {
                    producer.flush();
                    await(() -> answers().size() == 2 * (ANSWERED_BEFORE_THE_KILL / 2 + 1));
                } else if (i == SENT_BEFORE_THE_KILL / 2) {
                    producer.flush();
                    first.destroyForcibly().waitFor();
                }
            }
            producer.flush();
            await(() -> answers().size() >= REQUESTS);
        }

        Set<String> ids = new HashSet<>();
        answers().forEach(answer -> ids.add(answer.requestId().orElseThrow()));
        assertThat(answers())
                .hasSize(REQUESTS)
                .allMatch(answer -> answer.status().equals("created"));
        assertThat(ids).hasSize(REQUESTS);
        assertThat(records(Topics.DOMAINS)).hasSize(REQUESTS / 2);
        assertThat(records(Topics.REPLAYS)).hasSize(REQUESTS / 2);
    }

    @Tag("full")
    @Test
    void steersGroupsAsOneThoughTheInstanceThatDoesIsKilledAmongTheCommands() throws Exception {
        Process first = run("first", 1);
        List<String> groups = new ArrayList<>();
        int commands = 0;
        try (KafkaProducer<String, byte[]> producer = producer()) {
            for (int i = 0; i < GROUPS; i++) {
                group(producer, i);
            }
            producer.flush();
            await(() -> answers(Topics.REPLAY_MANAGER).size() == GROUPS);
            for (CommandResult answer : answers(Topics.REPLAY_MANAGER)) {
                groups.add(answer.json().path("group").asText());
            }
            run("second", 1); // gets a standby of the state, the work stays with the first
            for (String group : groups) {
                for (ReplayCommand command : steering(new ReplayCommand.Target(null, group))) {
                    producer.send(
                            new ProducerRecord<>(Topics.REPLAY_MANAGER, Requests.write("c-" + commands++, command)));
                }
                if (group.equals(groups.get(GROUPS / 2))) {
                    producer.flush();
                    first.destroyForcibly().waitFor(); // with commands under way
                }
            }
            producer.flush();
            int requested = GROUPS + commands;
            await(() -> answers(Topics.REPLAY_MANAGER).size() >= requested);
        }

        assertThat(answers(Topics.REPLAY_MANAGER))
                .hasSize(GROUPS + commands)
                .allMatch(answer -> !answer.status().equals(CommandResult.ERROR));
        Map<String, List<DesiredReplay>> newest = newestOfGroups();
        assertThat(newest.keySet()).containsExactlyInAnyOrderElementsOf(groups);
        assertThat(newest.values()).allSatisfy(members -> {
            DesiredReplay one = members.get(0);
            assertThat(one.desired()).isEqualTo(ReplayStatus.State.RUNNING);
            assertThat(one.speed()).isEqualTo(4);
            assertThat(one.seek().to()).isEqualTo(SOUGHT.toEpochMilli());
            assertThat(members).extracting(DesiredReplay::mission).containsExactlyInAnyOrder("north", "south");
            assertThat(members)
                    .extracting(DesiredReplay::desired, DesiredReplay::speed, DesiredReplay::seek, DesiredReplay::clock)
                    .containsOnly(tuple(one.desired(), one.speed(), one.seek(), one.clock()));
        });
    }

    private static List<ReplayCommand> steering(ReplayCommand.Target group) {
        return List.of(
                new ReplayCommand.Simple(group, ReplayCommand.Verb.PAUSE),
                new ReplayCommand.Seek(group, SOUGHT),
                new ReplayCommand.Speed(group, 4),
                new ReplayCommand.Simple(group, ReplayCommand.Verb.RESUME));
    }

    private static void group(KafkaProducer<String, byte[]> producer, int number) {
        ReplayPlan plan = new ReplayPlan(
                null,
                SOUGHT.minusSeconds(600).toEpochMilli(),
                SOUGHT.plusSeconds(600).toEpochMilli(),
                false,
                List.of(),
                null,
                ReplayPlan.Stamps.ORIGINAL,
                null,
                List.of());
        ReplayCommand command = new ReplayCommand.Start(List.of("north", "south"), null, 1, null, plan);
        producer.send(new ProducerRecord<>(Topics.REPLAY_MANAGER, Requests.write("g-" + number, command)));
    }

    /** The newest record of each replay, by its group. */
    private Map<String, List<DesiredReplay>> newestOfGroups() throws Exception {
        Map<String, DesiredReplay> newest = new HashMap<>();
        for (ConsumerRecord<String, byte[]> record : records(Topics.REPLAYS)) {
            newest.put(record.key(), DesiredReplay.read(record.key(), record.value()));
        }
        return newest.values().stream().collect(Collectors.groupingBy(DesiredReplay::group));
    }

    @Test
    void handsItsWorkOverToAnotherInstance() throws Exception {
        Path one = directory.resolve("one");
        Path two = directory.resolve("two");
        ControlPlane first = plane(one);
        try (KafkaProducer<String, byte[]> producer = producer();
                ControlPlane second = plane(two)) {
            await(() -> first.isHealthy() && second.isHealthy());
            create(producer, 0);
            await(() -> answers(Topics.DOMAIN_MANAGER).size() == 1);
            first.close();
            producer.send(new ProducerRecord<>(
                    Topics.MISSION_MANAGER,
                    Requests.write(
                            "m", new MissionCommand.Start("m", "d-0", new MissionPlan.Unspecified(), null, null))));
            await(() -> answers(Topics.MISSION_MANAGER).size() == 1);
            assertThat(answers(Topics.MISSION_MANAGER).get(0).status()).isEqualTo("created");
            assertThat(second.isHealthy()).isTrue();
        } finally {
            first.close();
        }
    }

    @Tag("full")
    @Test
    void runsNoOldRequestAgainThoughKafkaHasForgottenWhatWasRead() throws Exception {
        Path state = directory.resolve("state");
        try (KafkaProducer<String, byte[]> producer = producer()) {
            try (ControlPlane plane = plane(state)) {
                assertThat(plane.state()).isNotEqualTo("ERROR");
                send(producer, null, new DomainCommand.Create("north", DomainDetails.NONE));
                send(producer, null, new DomainCommand.Delete("north", false));
                await(() -> answers(Topics.DOMAIN_MANAGER).size() == 2);
            }
            try (Admin admin = Admin.create(kafka.client())) {
                Awaitility.await()
                        .atMost(TIMEOUT)
                        .ignoreExceptions()
                        .until(() -> admin.deleteConsumerGroups(List.of(ControlSettings.APPLICATION))
                                        .all()
                                        .get()
                                == null);
            }
            try (ControlPlane plane = plane(state)) {
                assertThat(plane.state()).isNotEqualTo("ERROR");
                send(producer, "last", new DomainCommand.Delete("nosuch", false));
                await(() -> answers(Topics.DOMAIN_MANAGER).stream()
                        .anyMatch(answer -> answer.requestId().equals(Optional.of("last"))));
            }
        }
        assertThat(answers(Topics.DOMAIN_MANAGER)).hasSize(3);
        assertThat(records(Topics.DOMAINS)).hasSize(2);
    }

    @Tag("full")
    @Test
    void putsTheCleanupPolicyOfItsTopicsRight() throws Exception {
        try (KafkaProducer<String, byte[]> producer = producer()) {
            producer.send(new ProducerRecord<>(Topics.DEVICES, "k", "{}".getBytes(UTF_8)))
                    .get();
        }
        ServiceTopics.prepare(ControlPlaneProcess.settings(kafka.bootstrapServers(), directory.toString()));
        ServiceTopics.prepare(ControlPlaneProcess.settings(kafka.bootstrapServers(), directory.toString()));

        await(() -> policy(Topics.DEVICES).equals("compact")
                && policy(Topics.MISSIONS_STATUS).equals("compact")
                && policy(Topics.MISSION_MANAGER).equals("delete"));
    }

    private ControlPlane plane(Path state) throws Exception {
        return ControlPlane.start(ControlPlaneProcess.settings(kafka.bootstrapServers(), state.toString())
                .withStandbyReplicas(1));
    }

    private Process run(String name, int standbyReplicas) throws Exception {
        Path state = directory.resolve(name);
        Files.createDirectories(state);
        Process process = ControlPlaneProcess.start(kafka.bootstrapServers(), state, standbyReplicas);
        processes.add(process);
        return process;
    }

    private static void create(KafkaProducer<String, byte[]> producer, int number) {
        DomainCommand command = new DomainCommand.Create("d-" + number, DomainDetails.NONE);
        producer.send(new ProducerRecord<>(Topics.DOMAIN_MANAGER, Requests.write("r-" + number, command)));
    }

    private static void replay(KafkaProducer<String, byte[]> producer, int number) {
        ReplayCommand command = new ReplayCommand.Start(List.of("m"), null, 1, null, ReplayPlan.PLAIN);
        producer.send(new ProducerRecord<>(Topics.REPLAY_MANAGER, Requests.write("p-" + number, command)));
    }

    private static void send(KafkaProducer<String, byte[]> producer, String requestId, DomainCommand command) {
        producer.send(new ProducerRecord<>(Topics.DOMAIN_MANAGER, 0, null, null, Requests.write(requestId, command)));
    }

    private KafkaProducer<String, byte[]> producer() {
        return new KafkaProducer<>(kafka.client(), new StringSerializer(), new ByteArraySerializer());
    }

    private List<CommandResult> answers() throws Exception {
        List<CommandResult> all = new ArrayList<>(answers(Topics.DOMAIN_MANAGER));
        all.addAll(answers(Topics.REPLAY_MANAGER));
        return all;
    }

    private List<CommandResult> answers(String topic) throws Exception {
        List<CommandResult> answers = new ArrayList<>();
        for (ConsumerRecord<String, byte[]> record : records(topic)) {
            if (new String(record.value(), UTF_8).contains("\"type\":\"response\"")) {
                answers.add(CommandResult.read(record.value()));
            }
        }
        return answers;
    }

    private List<ConsumerRecord<String, byte[]>> records(String topic) {
        return new TopicContent(kafka.client(), topic).records();
    }

    private String policy(String topic) throws Exception {
        ConfigResource resource = new ConfigResource(ConfigResource.Type.TOPIC, topic);
        try (Admin admin = Admin.create(kafka.client())) {
            return admin.describeConfigs(List.of(resource))
                    .all()
                    .get()
                    .get(resource)
                    .get("cleanup.policy")
                    .value();
        }
    }

    private static void await(Callable<Boolean> condition) {
        Awaitility.await().atMost(TIMEOUT).until(condition);
    }
}
