package io.furrow.soak.year;

import java.io.IOException;
import java.nio.file.Path;
import java.time.Duration;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.atomic.AtomicReference;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.AlterConfigOp;
import org.apache.kafka.clients.admin.ConfigEntry;
import org.apache.kafka.common.config.ConfigResource;

import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;
import io.furrow.soak.control.Http;
import io.furrow.soak.control.MosquittoProcess;
import io.furrow.soak.control.Until;
import io.furrow.soak.devices.StandInProcess;
import io.furrow.soak.devices.UpProcess;

/** Starts Mosquitto, the stand-ins of context broker and IoT Agent, and {@code ./furrow up} as processes. */
final class YearFarm implements AutoCloseable {
    private static final Duration TIMEOUT = Duration.ofMinutes(1);
    private static final int SEGMENTS = 4;
    /** Longer than the slowest week, so that records still exist when they are checked after it. */
    private static final double RETENTION_WEEKS = 1.75;

    /** The data folder of the suite. */
    final Path data;

    private final MosquittoProcess mosquitto;
    final StandInProcess standIn;
    final UpProcess up;
    final Tap tap;
    private final Set<String> retained = new HashSet<>();
    private long retentionMillis;

    /** @param furrow command that starts Furrow, without {@code up} */
    YearFarm(List<String> furrow, Path folder) throws IOException, InterruptedException {
        mosquitto = new MosquittoProcess(folder.resolve("mosquitto").toAbsolutePath());
        standIn = new StandInProcess(folder, mosquitto.uri());
        up = new UpProcess(
                furrow,
                folder.resolve("up"),
                List.of(
                        "--orion",
                        standIn.contextBroker().toString(),
                        "--start-timeout",
                        "5s",
                        "--window",
                        YearResults.WINDOW.toSeconds() + "s"));
        data = folder.resolve("up").resolve("data");
        tap = new Tap(up.port("notify"));
        up.with("--public-url", tap.publicUrl());
    }

    void start() throws IOException {
        mosquitto.start();
        standIn.start();
        up.start();
    }

    String mongo() {
        return "mongodb://127.0.0.1:" + up.port("mongo");
    }

    /** Repeats a request until it is accepted, since it may not be allowed yet. @return the response */
    JsonNode request(String method, String path, ObjectNode body) {
        byte[] bytes = body == null ? null : NgsiJson.write(body);
        AtomicReference<Http.Answer> answer = new AtomicReference<>();
        Until.isTrue(method + " " + path, TIMEOUT, () -> {
            answer.set(Http.send(method, up.api(path), bytes).join());
            return answer.get().status() / 100 == 2;
        });
        return answer.get().body();
    }

    /** Deletes a mission, its topic and its collection, which the control plane would delete a day later. */
    void delete(String mission) {
        request("DELETE", "/api/missions/" + mission, null);
        try (MongoClient client = MongoClients.create(mongo())) {
            deleteTopics(Topics.realtime(FarmYear.DOMAIN, mission));
            client.getDatabase(MongoAccess.DATABASE)
                    .getCollection(MissionCollections.nameOf(mission))
                    .drop();
        } catch (ExecutionException e) {
            throw new IllegalStateException("not deleted: " + mission, e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    void deleteTopics(String... topics) throws InterruptedException, ExecutionException {
        try (Admin admin = admin()) {
            Set<String> existing = admin.listTopics().names().get();
            admin.deleteTopics(
                            List.of(topics).stream().filter(existing::contains).toList())
                    .all()
                    .get();
        }
    }

    /**
     * Sets a retention for data topics without one, except those of missions, as an operator does with Kafka's tools.
     *
     * @param week duration of the week; that of the first call counts
     */
    void retain(Duration week) throws InterruptedException, ExecutionException {
        retentionMillis = retentionMillis == 0 ? (long) (RETENTION_WEEKS * week.toMillis()) : retentionMillis;
        try (Admin admin = admin()) {
            List<ConfigResource> topics = admin.listTopics().names().get().stream()
                    .filter(name ->
                            name.startsWith("data.") && !name.contains(".realtime.") && !Topics.isOfReplay(name))
                    .filter(name -> !retained.contains(name))
                    .map(name -> new ConfigResource(ConfigResource.Type.TOPIC, name))
                    .toList();
            Map<ConfigResource, java.util.Collection<AlterConfigOp>> changes = new HashMap<>();
            admin.describeConfigs(topics).all().get().forEach((topic, config) -> {
                retained.add(topic.name());
                if (config.get("cleanup.policy").value().equals("delete")) {
                    changes.put(
                            topic,
                            List.of(
                                    set("retention.ms", retentionMillis),
                                    set("segment.ms", retentionMillis / SEGMENTS)));
                }
            });
            admin.incrementalAlterConfigs(changes).all().get();
        }
    }

    private static AlterConfigOp set(String name, long value) {
        return new AlterConfigOp(new ConfigEntry(name, Long.toString(value)), AlterConfigOp.OpType.SET);
    }

    private Admin admin() {
        return Admin.create(Map.of("bootstrap.servers", up.kafka()));
    }

    @Override
    public void close() {
        up.close();
        standIn.close();
        mosquitto.close();
        tap.close();
    }
}
