package io.furrow.soak.ingest;

import java.time.Instant;
import java.util.Base64;
import java.util.List;
import java.util.stream.Stream;

import org.apache.kafka.clients.producer.ProducerRecord;

import io.furrow.files.RandomPicture;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * Generates records of {@code data.raw} by number: of thermometers, of robots that name no mission and change it
 * meanwhile, and of cameras; with repeats, deletions, late events and records that become dead letters.
 */
final class FarmLoad {
    static final int PARTITIONS = 4;
    static final String DOMAIN = "farm";

    private static final long TIME = 1_700_000_000_000L;
    private static final long ROBOTS_CHANGE = TIME + 4_000;
    private static final List<String> ROBOTS = List.of("robot-6", "robot-7", "robot-16", "robot-17");

    private FarmLoad() {}

    /** The versions of the robots on {@code service.devices}. */
    static Stream<DeviceVersion> devices() {
        return ROBOTS.stream()
                .flatMap(robot -> Stream.of(
                        new DeviceVersion(robot, "farm", "/", DOMAIN, "weeding", 0, null, 1, null),
                        new DeviceVersion(robot, "farm", "/", DOMAIN, "spraying", ROBOTS_CHANGE, null, 2, null)));
    }

    static ProducerRecord<byte[], byte[]> record(int number) {
        if (number % 50 == 49) {
            return record(number - 7); // a repeat has the same event id
        }
        long time = TIME + number - (number % 37 == 36 ? 700 : 0);
        String thermometer = "thermometer-" + number % 36;
        if (number % 97 == 96) {
            return record(number, null, time, thermometer, "{\"id\":\"" + thermometer);
        }
        if (number % 211 == 210) {
            return record(number, null, time, thermometer, null);
        }
        return switch (number % 10) {
            case 6, 7 -> report(number, time, "robot-" + number % 20, "");
            case 8 -> report(number, time, "camera-" + number % 40, belonging(number) + "," + image(number));
            case 9 -> report(number, time, "stray-" + number % 30, ""); // without a domain
            default -> report(number, time, thermometer, belonging(number) + "," + oddity(number));
        };
    }

    /** The last record of a partition: once its event is written, all before it were read. */
    static ProducerRecord<byte[], byte[]> closing(int partition, int number) {
        String id = "closing-" + partition;
        return record(number + partition, partition, TIME + number, id, entity(id, number, belonging(number)));
    }

    static boolean isClosing(byte[] key) {
        return new String(key, UTF_8).startsWith("closing-");
    }

    private static String belonging(int number) {
        return attribute("Domain", "\"" + DOMAIN + "\"") + ","
                + attribute("Mission", number % 3 == 0 ? "\"weeding\"" : "\"sowing\"");
    }

    /** The image of every 101st camera is invalid. */
    private static String image(int number) {
        return attribute(
                "Image",
                '"'
                        + (number % 101 == 100
                                ? "bm8gaW1hZ2U="
                                : Base64.getEncoder().encodeToString(RandomPicture.of("png", number)))
                        + '"');
    }

    /** Some reports have a number that MongoDB cannot represent. */
    private static String oddity(int number) {
        return attribute("Odd" + number % 5, number % 83 == 82 ? "1234567890".repeat(4) : Integer.toString(number));
    }

    private static ProducerRecord<byte[], byte[]> report(int number, long time, String id, String attributes) {
        return record(number, null, time, id, entity(id, number, attributes));
    }

    private static String entity(String id, int number, String attributes) {
        return "{\"id\":\"%s\",\"type\":\"%s\",%s%s}"
                .formatted(
                        id,
                        id.substring(0, id.indexOf('-')),
                        attribute("Number", Integer.toString(number)),
                        attributes.isEmpty() ? "" : "," + attributes);
    }

    private static String attribute(String name, String value) {
        return "\"" + name + "\":{\"type\":\"X\",\"value\":" + value + ",\"metadata\":{}}";
    }

    private static ProducerRecord<byte[], byte[]> record(
            int number, Integer partition, long time, String key, String value) {
        ProducerRecord<byte[], byte[]> record =
                new ProducerRecord<>(Topics.RAW, partition, time, utf8(key), value == null ? null : utf8(value));
        record.headers()
                .add(HeaderNames.CE_ID, utf8("event-" + number))
                .add(HeaderNames.CE_TIME, utf8(Instant.ofEpochMilli(time).toString()))
                .add(HeaderNames.SERVICE, utf8("farm"))
                .add(HeaderNames.SERVICE_PATH, utf8("/"))
                .add(HeaderNames.TS_DEVICE, utf8(Long.toString(time)))
                .add(HeaderNames.TS_SOURCE, utf8(Long.toString(time + 5)));
        return record;
    }

    static byte[] utf8(String text) {
        return text.getBytes(UTF_8);
    }
}
