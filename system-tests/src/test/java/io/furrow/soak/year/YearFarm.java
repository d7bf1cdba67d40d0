package io.furrow.soak.year;

import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ExecutionException;

import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import org.apache.kafka.clients.admin.Admin;

import io.furrow.mission.mongo.MongoAccess;
import io.furrow.soak.control.Mosquitto;
import io.furrow.soak.devices.StandInProcess;
import io.furrow.soak.devices.UpProcess;

/** Mosquitto, the stand-ins of context broker and IoT Agent, and {@code ./furrow up}, each a process of its own. */
final class YearFarm implements AutoCloseable {
    private final Path data;
    private final Mosquitto mosquitto;
    private final StandInProcess standIn;
    private final UpProcess up;
    private final Tap tap;

    YearFarm(Path home, Path folder) throws IOException, InterruptedException {
        mosquitto = new Mosquitto(folder.resolve("mosquitto").toAbsolutePath());
        standIn = new StandInProcess(folder, mosquitto.uri());
        up = new UpProcess(
                home,
                folder.resolve("up"),
                List.of("--orion", standIn.contextBroker().toString(), "--start-timeout", "20s"));
        data = folder.resolve("up").resolve("data");
        tap = new Tap(up.port("notify"));
        up.with("--public-url", tap.publicUrl());
    }

    void start() throws IOException {
        mosquitto.start();
        standIn.start();
        up.start();
    }

    UpProcess up() {
        return up;
    }

    StandInProcess standIn() {
        return standIn;
    }

    Tap tap() {
        return tap;
    }

    String mongo() {
        return "mongodb://127.0.0.1:" + up.port("mongo");
    }

    /** Does what the control plane and a retention of missions do after more time than there is here. */
    void forget(String topic, String collection) throws InterruptedException, ExecutionException {
        try (Admin admin = Admin.create(Map.of("bootstrap.servers", up.kafka()));
                MongoClient client = MongoClients.create(mongo())) {
            admin.deleteTopics(List.of(topic)).all().get();
            client.getDatabase(MongoAccess.DATABASE).getCollection(collection).drop();
        }
    }

    /** Of the suite. */
    Path data() {
        return data;
    }

    @Override
    public void close() {
        up.close();
        standIn.close();
        mosquitto.close();
        tap.close();
    }
}
