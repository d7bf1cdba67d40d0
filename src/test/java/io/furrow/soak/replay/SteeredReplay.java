package io.furrow.soak.replay;

import java.time.Clock;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Random;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.mongodb.client.MongoClient;
import org.bson.RawBsonDocument;

import io.furrow.mission.StoredEvent;
import io.furrow.mission.mongo.EventDocumentCodec;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.Retention;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayCommand;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.control.ReplayStatus.State;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/** A mission of numbered events that is replayed in a loop, and the desired state of its replay. */
final class SteeredReplay {
    /** The attribute with an event's number. */
    static final String NUMBER = "n";

    private static final long TIME = 1_600_000_000_000L;
    private static final int EVENTS = 2_000;
    private static final int INTERVAL_MS = 20;
    private static final int DEVICES = 5;
    private static final double[] SPEEDS = {0.5, 1, 2, 5, 20, ReplayCommand.MAX};
    private static final ReplayPlan LOOP =
            new ReplayPlan(null, null, null, true, List.of(), null, ReplayPlan.Stamps.ORIGINAL, null, List.of());

    private final int index;
    private DesiredReplay desired;

    SteeredReplay(int index) {
        this.index = index;
        this.desired = DesiredReplay.started(mission(index), topic(index), LOOP, 1, 0, 1);
    }

    private static String mission(int index) {
        return "soak" + index;
    }

    static String topic(int index) {
        return Topics.replay(mission(index), "0a1b2c3d");
    }

    DesiredReplay desired() {
        return desired;
    }

    void store(MongoClient client) throws UnreadableException {
        MissionCollections missions = new MissionCollections(client, Retention.of(null, Map.of()), Clock.systemUTC());
        List<RawBsonDocument> events = new ArrayList<>();
        for (int i = 0; i < EVENTS; i++) {
            String id = "urn:ngsi-ld:Robot:" + i % DEVICES;
            ObjectNode entity =
                    JsonNodeFactory.instance.objectNode().put("id", id).put("type", "Robot");
            entity.putObject(NUMBER).put("type", "Integer").put("value", i).putObject("metadata");
            StoredEvent event = new StoredEvent(
                    "e%05d".formatted(i), TIME + i * INTERVAL_MS, id, Map.of("ce_source", "/soak"), entity);
            events.add(new RawBsonDocument(EventDocumentCodec.write(event)));
        }
        missions.prepared(MissionCollections.nameOf(mission(index))).insertMany(events);
    }

    /** Changes the desired state at random. @return the command's name */
    String steer(Random random) {
        long next = desired.sequence() + 1;
        boolean paused = desired.desired() == State.PAUSED;
        switch (random.nextInt(4)) {
            case 0 -> {
                desired = desired.desired(paused ? State.RUNNING : State.PAUSED, next);
                return paused ? "resume" : "pause";
            }
            case 1 -> {
                desired = desired.seeking(TIME + random.nextInt(EVENTS * INTERVAL_MS), next);
                return "seek";
            }
            case 2 -> {
                desired = desired.at(SPEEDS[random.nextInt(SPEEDS.length)], next);
                return "speed";
            }
            default -> {
                int steps = random.nextInt(4) == 0 ? -1 - random.nextInt(5) : 1 + random.nextInt(20);
                desired = desired.desired(State.PAUSED, next).stepping(steps, next);
                return "step";
            }
        }
    }

    void stop() {
        desired = desired.desired(State.STOPPED, desired.sequence() + 1);
    }
}
