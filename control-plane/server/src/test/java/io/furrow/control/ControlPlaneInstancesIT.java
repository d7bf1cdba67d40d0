package io.furrow.control;

import java.nio.file.Path;
import java.util.List;
import java.util.Optional;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.config.ConfigResource;
import org.awaitility.Awaitility;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.model.control.DomainCommand;
import io.furrow.model.control.DomainDetails;
import io.furrow.model.control.MissionCommand;
import io.furrow.model.control.MissionPlan;
import io.furrow.model.control.Requests;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

@Tag("full")
class ControlPlaneInstancesIT extends ControlPlaneFixture {
    @Test
    void handsOverToAnotherInstance() throws Exception {
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

    @Test
    void executesNoOldRequestAgainIfOffsetsAreLost() throws Exception {
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

    @Test
    void correctsTheCleanupPolicyOfExistingTopics() throws Exception {
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

    private static void send(KafkaProducer<String, byte[]> producer, String requestId, DomainCommand command) {
        producer.send(new ProducerRecord<>(Topics.DOMAIN_MANAGER, 0, null, null, Requests.write(requestId, command)));
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
}
