package io.furrow.soak.control;

import java.util.Random;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.control.AlarmKind;
import io.furrow.model.control.DeviceGroup;
import io.furrow.model.control.Limits;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

/**
 * Generates random requests of all commands with all members, each legal and as extreme as possible: sizes around the
 * limit, the maximum numbers of groups, devices and points, the longest names. Uses few names, so that requests refer
 * to each other's domains and missions.
 */
final class ExtremeRequests {
    private static final int NAMES = 8;
    private static final int MAX_NAME_LENGTH = 64;
    private static final int MAX_ID_LENGTH = 200;
    private static final int MAX_TEXT_LENGTH = 4096;
    /** The member that the API adds to a request. */
    private static final String USER = "rest";

    /** A member that no request knows: the API refuses it, the managers ignore it. */
    static final String PADDING = "note";

    private final Random random;
    private int number;

    ExtremeRequests(long seed) {
        random = new Random(seed);
    }

    ControlRequest next() {
        ObjectNode members = JsonNodeFactory.instance.objectNode();
        return switch (random.nextInt(10)) {
            case 0, 1 -> request(Topics.DOMAIN_MANAGER, domain(members), members);
            case 2, 3, 4, 5, 6 -> request(Topics.MISSION_MANAGER, mission(members), members);
            case 7, 8 -> request(Topics.REPLAY_MANAGER, replay(members), members);
            default -> request(Topics.ALARM_MANAGER, alarm(members), members);
        };
    }

    /** One request of ten has the maximum size, or is one byte shorter or longer. */
    private ControlRequest request(String topic, String command, ObjectNode members) {
        ControlRequest request = new ControlRequest(id(), topic, command, members);
        if (random.nextInt(10) == 0) {
            int missing = Limits.REQUEST_BYTES - 1 + random.nextInt(3) - size(request) - ",\"note\":\"\"".length();
            if (missing > 0) {
                members.put(PADDING, "x".repeat(missing));
            }
        }
        return request;
    }

    /** The size of a request as sent by the API, choice adds a user. */
    static int size(ControlRequest request) {
        ObjectNode json = JsonNodeFactory.instance.objectNode();
        json.setAll(request.members());
        json.put("type", "request").put("requestId", request.id());
        json.put("command", request.command()).put("user", USER);
        return NgsiJson.write(json).length;
    }

    private String id() {
        String id = "r-" + number++;
        return random.nextInt(10) == 0 ? id + "~".repeat(MAX_ID_LENGTH - id.length()) : id;
    }

    private String domain(ObjectNode members) {
        members.put("domain", name("domain"));
        int choice = random.nextInt(10);
        if (choice == 0) {
            members.put("force", random.nextBoolean());
            return "delete";
        }
        sometimes(() -> members.put("name", text()));
        sometimes(() -> members.put("description", text()));
        sometimes(() -> members.set("area", area()));
        sometimes(() -> members.set("fields", ids("field", random.nextInt(2000))));
        return choice < 4 ? "change" : "create";
    }

    private String mission(ObjectNode members) {
        int choice = random.nextInt(21);
        if (choice == 20) {
            members.put("device", max("urn:ngsi-ld:Thermometer:", MAX_ID_LENGTH));
            return "rotate-credentials";
        } else if (choice < 2) {
            members.put("template", name("template"));
            sometimes(() -> members.put("version", 1 + random.nextInt(3)));
            return "delete-template";
        } else if (choice < 5) {
            members.put("template", name("template")).put("description", text());
            members.set("devices", devices());
            return "save-template";
        }
        members.put("mission", name("mission"));
        if (choice < 8) {
            return choice < 7 ? "stop" : "delete";
        } else if (choice < 11) {
            members.set("devices", devices());
            return "add-devices";
        }
        members.put("domain", name("domain"));
        if (random.nextInt(4) == 0) {
            members.put("template", name("template") + (random.nextBoolean() ? "@1" : ""));
        } else if (random.nextInt(4) > 0) {
            members.set("devices", devices());
        }
        if (choice < 15) {
            return "create";
        }
        sometimes(() ->
                members.put("start", pick("2026-03-01T08:00:00Z", "9999-12-31T23:59:59Z", "1970-01-01T00:00:00Z")));
        sometimes(() -> members.put("duration", pick("PT0.001S", "PT2H", "PT87840H", "PT1S")));
        return "start";
    }

    private String replay(ObjectNode members) {
        if (random.nextInt(3) > 0) {
            members.put("mission", name("mission")).put("loop", random.nextBoolean());
            sometimes(() -> members.put("from", 0).put("to", "9999-12-31T23:59:59Z"));
            sometimes(() -> members.put("speed", random.nextBoolean() ? 0.1 : 1000));
            sometimes(() -> members.set("devices", ids("urn:device", random.nextInt(2500))));
            return "start";
        }
        members.put("replay", name("mission") + "." + String.format("%08x", random.nextInt()));
        String command = pick("stop", "pause", "resume", "seek", "speed", "step");
        switch (command) {
            case "seek" -> members.put("to", 253_402_300_799_000L);
            case "speed" -> members.put("speed", "max");
            case "step" -> members.put("count", 1_000_000);
            default -> {}
        }
        return command;
    }

    private String alarm(ObjectNode members) {
        String command = pick("acknowledge", "close", "mute", "unmute");
        boolean ofKind = command.endsWith("mute") && random.nextBoolean();
        if (ofKind) {
            members.put("kind", AlarmKind.values()[random.nextInt(AlarmKind.values().length)].code());
            sometimes(() -> members.put("subject", text()));
        } else {
            members.put("alarm", random.nextBoolean() ? "collision-1" : max("alarm"));
        }
        if (command.equals("mute")) {
            members.put("for", pick("PT1S", "PT87840H", "PT0.001S"));
        }
        return command;
    }

    /** Few devices, the maximum number of groups or devices, or the largest settings. */
    private ArrayNode devices() {
        ArrayNode devices = JsonNodeFactory.instance.arrayNode();
        switch (random.nextInt(20)) {
            case 0 -> {
                for (int i = 0; i < DeviceGroup.MAX; i++) {
                    devices.addObject().put("type", "T").put("name", "n" + number + "-" + i);
                }
            }
            case 1 -> group(devices, DeviceGroup.MAX - random.nextInt(2));
            case 2 -> {
                ObjectNode group = group(devices, 1 + random.nextInt(40));
                group.set("path", points(2500));
                group.putObject("parameters").put("note", "p".repeat(1 + random.nextInt(100_000)));
            }
            case 3 -> ids("urn:device", 2000).forEach(devices::add);
            case 4 -> group(devices, 200).set("area", area());
            case 5 -> {
                ArrayNode faults = group(devices, 2).put("speed", 100).putArray("faults");
                for (int i = 0; i < DeviceGroup.MAX; i++) {
                    faults.addObject().put("kind", pick("stuck", "drift", "spikes", "silent"));
                }
            }
            case 6 -> carried(devices);
            default -> {
                for (int i = random.nextInt(4); i >= 0; i--) {
                    group(devices, 1 + random.nextInt(3));
                }
            }
        }
        return devices;
    }

    private ObjectNode group(ArrayNode devices, int count) {
        ObjectNode group = devices.addObject().put("type", pick("Thermometer", "Camera", "T".repeat(MAX_NAME_LENGTH)));
        if (count == 1 && random.nextBoolean()) {
            return group.put("id", max("urn:ngsi-ld:Thermometer:" + number + "-" + devices.size(), MAX_ID_LENGTH));
        }
        sometimes(() -> group.put("period", pick("PT0.001S", "PT1S", "PT87840H")));
        return group.put("count", count);
    }

    /** A hundred groups, each carried by the one before. */
    private void carried(ArrayNode devices) {
        for (int i = 0; i < 100; i++) {
            ObjectNode group = group(devices, 2).put("name", "carrier-" + i);
            if (i > 0) {
                group.put("carriedBy", "carrier-" + (i - 1));
            }
        }
    }

    /** An area of up to 20,000 corners. */
    private ObjectNode area() {
        ObjectNode area = JsonNodeFactory.instance.objectNode().put("type", "Polygon");
        area.putArray("coordinates").add(points(4 + random.nextInt(random.nextInt(5) == 0 ? 20_000 : 100)));
        return area;
    }

    private ArrayNode points(int count) {
        ArrayNode points = JsonNodeFactory.instance.arrayNode();
        for (int i = 0; i < count; i++) {
            points.addArray().add(random.nextInt(3600) / 10.0 - 180).add(random.nextInt(1800) / 10.0 - 90);
        }
        return points;
    }

    private ArrayNode ids(String prefix, int count) {
        ArrayNode ids = JsonNodeFactory.instance.arrayNode();
        for (int i = 0; i < count; i++) {
            ids.add(max(prefix + ":" + number + ":" + i, MAX_ID_LENGTH));
        }
        return ids;
    }

    /** One of few names; every other one has the maximum length. */
    private String name(String kind) {
        int choice = random.nextInt(NAMES);
        return choice % 2 == 0 ? kind + choice : max(kind + choice, MAX_NAME_LENGTH);
    }

    private static String max(String start) {
        return max(start, MAX_NAME_LENGTH);
    }

    private static String max(String start, int length) {
        return start + "_".repeat(length - start.length());
    }

    /** A text up to the maximum length, of characters of one to four bytes. */
    private String text() {
        String character = pick("a", "\u00e4", "\u20ac", "\ud83d\ude9c", "\"");
        return character.repeat(random.nextInt(MAX_TEXT_LENGTH / character.length() + 1));
    }

    private String pick(String... choices) {
        return choices[random.nextInt(choices.length)];
    }

    private void sometimes(Runnable member) {
        if (random.nextInt(3) == 0) {
            member.run();
        }
    }
}
