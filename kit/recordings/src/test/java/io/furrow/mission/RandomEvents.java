package io.furrow.mission;

import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Random;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** Generates events with few different times, and with ids that Java and UTF-8 order differently. */
public final class RandomEvents {
    public static final long TIME = 1_700_000_000_000L;

    private static final String[] CHARACTERS = {"a", "b", "Z", "é", "\uFFFD", "\uD83D\uDE9C"};

    private RandomEvents() {}

    public static List<StoredEvent> of(Random random, int number) {
        int times = 1 + random.nextInt(2 * number + 1);
        List<StoredEvent> events = new ArrayList<>();
        for (int i = 0; i < number; i++) {
            StringBuilder id = new StringBuilder();
            for (int position = 0; position < 3; position++) {
                id.append(CHARACTERS[random.nextInt(CHARACTERS.length)]);
            }
            events.add(event(id.toString() + i, TIME + random.nextInt(times), random.nextInt(300)));
        }
        return events;
    }

    /** @param padding bytes of a meaningless value */
    public static StoredEvent event(String id, long time, int padding) {
        JsonNodeFactory nodes = JsonNodeFactory.instance;
        ObjectNode entity = nodes.objectNode();
        entity.put("id", "t1").put("type", "Thermometer");
        entity.putObject("Note").put("type", "Text").put("value", "x".repeat(padding));
        return new StoredEvent(id, time, "t1", Map.of("fiware-service", "farm"), entity);
    }
}
