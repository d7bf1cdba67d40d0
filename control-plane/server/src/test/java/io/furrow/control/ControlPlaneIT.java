package io.furrow.control;

import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Instant;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.stream.Collectors;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.model.control.CommandResult;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.DomainCommand;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.control.Requests;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

class ControlPlaneIT extends ControlPlaneFixture {
    private static final int GROUPS = 10;
    private static final Instant SEEK_TARGET = Instant.parse("2026-05-01T08:00:00Z");
    private static final int REQUESTS = 100;
    private static final int ANSWERED_BEFORE_THE_KILL = 30;
    private static final int SENT_BEFORE_THE_KILL = 60;

    private final List<Process> processes = new ArrayList<>();

    @AfterEach
    void killProcesses() throws Exception {
        for (Process process : processes) {
            process.destroyForcibly().waitFor();
        }
    }

    @Tag("full")
    @Test
    void executesEachOfAHundredRequestsOnceThoughItIsKilled() throws Exception {
        Process first = run("first", 0);
        try (KafkaProducer<String, byte[]> producer = producer()) {
            for (int i = 0; i < REQUESTS; i++) {
                create(producer, i);
                create(producer, i); // like a client without an answer
                if (i == ANSWERED_BEFORE_THE_KILL) {
                    producer.flush();
                    await(() -> answers(Topics.DOMAIN_MANAGER).size() > ANSWERED_BEFORE_THE_KILL);
                } else if (i == SENT_BEFORE_THE_KILL) {
                    producer.flush();
                    first.destroyForcibly().waitFor(); // with requests in flight
                    assertThat(answers(Topics.DOMAIN_MANAGER)).hasSizeLessThan(REQUESTS);
                }
            }
            producer.flush();
            run("second", 0); // restores its state from Kafka
            await(() -> answers(Topics.DOMAIN_MANAGER).size() >= REQUESTS);

            // Any second answer would arrive before this one.
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

    /** Domains are one task and replays another, so each of two instances has one of them. */
    @Tag("full")
    @Test
    void takesOverFromAKilledInstance() throws Exception {
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
    void changesGroupsAtomicallyThoughItIsKilled() throws Exception {
        Process first = run("first", 1);
        List<String> groups = new ArrayList<>();
        int commands = 0;
        try (KafkaProducer<String, byte[]> producer = producer()) {
            for (int i = 0; i < GROUPS; i++) {
                startGroup(producer, i);
            }
            producer.flush();
            await(() -> answers(Topics.REPLAY_MANAGER).size() == GROUPS);
            for (CommandResult answer : answers(Topics.REPLAY_MANAGER)) {
                groups.add(answer.json().path("group").asText());
            }
            run("second", 1); // gets standby tasks, the active ones stay with the first
            for (String group : groups) {
                for (ReplayCommand command : commandsTo(new ReplayCommand.Target(null, group))) {
                    producer.send(
                            new ProducerRecord<>(Topics.REPLAY_MANAGER, Requests.write("c-" + commands++, command)));
                }
                if (group.equals(groups.get(GROUPS / 2))) {
                    producer.flush();
                    first.destroyForcibly().waitFor(); // with commands in flight
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
            assertThat(one.seek().to()).isEqualTo(SEEK_TARGET.toEpochMilli());
            assertThat(members).extracting(DesiredReplay::mission).containsExactlyInAnyOrder("north", "south");
            assertThat(members)
                    .extracting(DesiredReplay::desired, DesiredReplay::speed, DesiredReplay::seek, DesiredReplay::clock)
                    .containsOnly(tuple(one.desired(), one.speed(), one.seek(), one.clock()));
        });
    }

    private static List<ReplayCommand> commandsTo(ReplayCommand.Target group) {
        return List.of(
                new ReplayCommand.Simple(group, ReplayCommand.Verb.PAUSE),
                new ReplayCommand.Seek(group, SEEK_TARGET),
                new ReplayCommand.Speed(group, 4),
                new ReplayCommand.Simple(group, ReplayCommand.Verb.RESUME));
    }

    private static void startGroup(KafkaProducer<String, byte[]> producer, int number) {
        ReplayPlan plan = new ReplayPlan(
                null,
                SEEK_TARGET.minusSeconds(600).toEpochMilli(),
                SEEK_TARGET.plusSeconds(600).toEpochMilli(),
                false,
                List.of(),
                null,
                ReplayPlan.Stamps.ORIGINAL,
                null,
                List.of());
        ReplayCommand command = new ReplayCommand.Start(List.of("north", "south"), null, 1, null, plan);
        producer.send(new ProducerRecord<>(Topics.REPLAY_MANAGER, Requests.write("g-" + number, command)));
    }

    /** Returns the newest record of each replay by its group. */
    private Map<String, List<DesiredReplay>> newestOfGroups() throws Exception {
        Map<String, DesiredReplay> newest = new HashMap<>();
        for (ConsumerRecord<String, byte[]> record : records(Topics.REPLAYS)) {
            newest.put(record.key(), DesiredReplay.read(record.key(), record.value()));
        }
        return newest.values().stream().collect(Collectors.groupingBy(DesiredReplay::group));
    }

    private Process run(String name, int standbyReplicas) throws Exception {
        Path state = directory.resolve(name);
        Files.createDirectories(state);
        Process process = ControlPlaneProcess.start(kafka.bootstrapServers(), state, standbyReplicas);
        processes.add(process);
        return process;
    }

    private static void replay(KafkaProducer<String, byte[]> producer, int number) {
        ReplayCommand command = new ReplayCommand.Start(List.of("m"), null, 1, null, ReplayPlan.PLAIN);
        producer.send(new ProducerRecord<>(Topics.REPLAY_MANAGER, Requests.write("p-" + number, command)));
    }

    private List<CommandResult> answers() throws Exception {
        List<CommandResult> all = new ArrayList<>(answers(Topics.DOMAIN_MANAGER));
        all.addAll(answers(Topics.REPLAY_MANAGER));
        return all;
    }
}
