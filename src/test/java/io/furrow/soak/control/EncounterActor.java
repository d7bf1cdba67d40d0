package io.furrow.soak.control;

import java.util.ArrayDeque;
import java.util.Deque;
import java.util.Map;
import java.util.Random;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

/**
 * Writes encounters as the job {@code collision} does, one per pair: its alarm must be raised, and closed when the
 * encounter has ended. Acknowledges, mutes and closes alarms that the webhook received.
 */
final class EncounterActor {
    /** Below the number from which alarms are combined into one alarm of a group. */
    private static final int MAX_OPEN = 8;

    private final RequestSender sender;
    private final Requester requester;
    private final AlarmReceiver receiver;
    private final Random random;
    private final Map<String, Boolean> ended = new TreeMap<>();
    private final Deque<Integer> open = new ArrayDeque<>();
    private int number;
    private int requests;

    EncounterActor(RequestSender sender, Requester requester, AlarmReceiver receiver, Random random) {
        this.sender = sender;
        this.requester = requester;
        this.receiver = receiver;
        this.random = random;
    }

    /** Maps each pair to whether its encounter has ended. */
    Map<String, Boolean> pairs() {
        return ended;
    }

    void step() throws InterruptedException {
        int choice = random.nextInt(10);
        if (choice < 5 && open.size() < MAX_OPEN) {
            number++;
            write(number, "started");
            open.add(number);
            ended.put(pair(number), false);
        } else if (choice < 8 && open.size() > MAX_OPEN / 2) {
            int ending = open.remove();
            write(ending, "ended");
            ended.put(pair(ending), true);
        } else {
            command();
        }
    }

    private void command() throws InterruptedException {
        for (JsonNode alarm : receiver.newest()) {
            boolean selected = alarm.path("kind").asText().equals("collision") && random.nextInt(5) == 0;
            if (selected && !alarm.path("state").asText().equals("closed")) {
                ObjectNode members = JsonNodeFactory.instance
                        .objectNode()
                        .put("alarm", alarm.path("alarm").asText());
                String command = random.nextBoolean() ? "acknowledge" : random.nextBoolean() ? "mute" : "close";
                if (command.equals("mute")) {
                    members.put("for", "PT5S");
                }
                requester.request(
                        new ControlRequest("alarm-" + requests++, Topics.ALARM_MANAGER, command, members), random);
                return;
            }
        }
    }

    private static String pair(int number) {
        return "robot-%da-robot-%db".formatted(number, number);
    }

    private void write(int encounter, String phase) throws InterruptedException {
        Entity entity = Entity.builder("Analytics:Collision:" + encounter, "Analytics:Collision")
                .text("encounter", "e-" + encounter)
                .text("phase", phase)
                .text("Device1_ID", "robot-" + encounter + "a")
                .text("Device2_ID", "robot-" + encounter + "b")
                .number("distance", 3)
                .build();
        sender.writeWithRetry(new ProducerRecord<>(Topics.COLLISION, pair(encounter), entity.toBytes()));
    }
}
