package io.furrow.deployment;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.ExecutionException;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;

import io.furrow.embedded.EmbeddedMongo;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.http.AllowedNames;
import io.furrow.model.topic.Topics;

/** Runs stand-ins for the context broker, the IoT Agent and MongoDB in one process, and creates the topic {@code data.raw}. */
public final class StandIns {
    private StandIns() {}

    /**
     * Arguments: folder; ports of context broker, IoT Agent, MongoDB and {@link NotificationRetries}; URI of the MQTT broker, the IoT
     * Agent's user and password there; bootstrap servers of Kafka, unless the topic exists. Runs until it is killed.
     */
    public static void main(String... args) throws IOException, InterruptedException, ExecutionException {
        if (args.length > 8) {
            createRaw(args[8]);
        }
        Path folder = Path.of(args[0]);
        EmbeddedMongo.start(folder, Integer.parseInt(args[3]));
        NotificationRetries.start(Integer.parseInt(args[4]));
        FiwareStandIn.start(new FiwareSettings(
                Integer.parseInt(args[1]),
                Integer.parseInt(args[2]),
                URI.create(args[5]),
                args[6],
                args[7],
                folder.resolve("fiware.json"),
                FiwareSettings.Connections.PERSISTENT,
                new AllowedNames(List.of("orion", "iot-agent"), List.of())));
        new CountDownLatch(1).await();
    }

    private static void createRaw(String bootstrapServers) throws InterruptedException, ExecutionException {
        try (Admin admin = Admin.create(Map.of("bootstrap.servers", bootstrapServers))) {
            NewTopic raw = new NewTopic(Topics.RAW, Optional.empty(), Optional.empty());
            admin.createTopics(List.of(raw)).all().get();
        }
    }
}
