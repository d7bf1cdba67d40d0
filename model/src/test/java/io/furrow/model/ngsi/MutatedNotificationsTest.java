package io.furrow.model.ngsi;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

import io.furrow.model.event.EntityEvent;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.Origin;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.fail;

/** Recorded notifications, broken at random: either unreadable, or an entity that every accessor and reader can take. */
@Timeout(60)
class MutatedNotificationsTest {
    private static final long SEED = 20261121;
    private static final int ROUNDS = 6000;
    private static final Instant RECEIVED = Instant.parse("2026-11-21T01:11:05Z");
    private static final Duration SKEW = Duration.ofMinutes(5);
    private static final String[] HEADERS = {
        null, "normalized", "keyValues", "simplifiedNormalized", "simplifiedKeyValues", "values"
    };
    private static final String[] SPLICES = {
        "null",
        "{}",
        "[]",
        "1e999",
        "-1e999999999",
        "1000e2147483647",
        "1e99999999999",
        "\"\\ud800\"",
        "NaN",
        "\"\"",
        "{\"value\":null}",
        "{\"type\":null,\"value\":1,\"metadata\":[]}",
        "\"%27\"",
        "[[[[]]]]",
        "\"0,0\"",
        "-1",
        "true",
        "{\"type\":\"Point\",\"coordinates\":{\"a\":1,\"b\":2}}",
        "\"9999-12-31T23:59:59Z\"",
        "999999999999999999",
        "\"+999999999-12-31T23:59:59Z\"",
        "\"2026-11-21T01:00:00/\""
    };
    private static final String[] NAMES = {
        "id",
        "type",
        "data",
        "value",
        "metadata",
        "location",
        "Time",
        "TimeInstant",
        "dateObserved",
        "dateModified",
        "Latitude",
        "Longitude",
        "gnss",
        "coordinates"
    };

    private final Random random = new Random(SEED);

    @Test
    void areUnreadableOrFitForEverything() {
        List<RecordedNotification> recorded = RecordedNotification.all();
        int read = 0;
        int unreadable = 0;
        for (int round = 0; round < ROUNDS; round++) {
            byte[] body = mutated(recorded.get(random.nextInt(recorded.size())).body());
            String header = HEADERS[random.nextInt(HEADERS.length)];
            try {
                for (Entity entity : Notification.read(body, header).entities()) {
                    use(entity);
                    read++;
                }
            } catch (UnreadableException e) {
                assertThat(e).hasMessageMatching("(?s).+");
                unreadable++;
            } catch (RuntimeException | StackOverflowError e) {
                fail(
                        "seed %d round %d header %s body %s",
                        SEED, round, header, new String(body, StandardCharsets.UTF_8), e);
            }
        }
        assertThat(read).as("entities that could be read").isGreaterThan(ROUNDS / 5);
        assertThat(unreadable).as("bodies that could not").isGreaterThan(ROUNDS / 5);
    }

    private static void use(Entity entity) throws UnreadableException {
        assertThat(Entity.parse(entity.toBytes())).isEqualTo(entity);
        entity.type();
        entity.attributes().forEach(attribute -> {
            entity.value(attribute.getKey());
            entity.text(attribute.getKey());
            entity.number(attribute.getKey());
        });
        PositionReading.of(entity).usable().ifPresent(position -> {
            assertThat(position.latitude()).isBetween(-90.0, 90.0);
            assertThat(position.longitude()).isBetween(-180.0, 180.0);
        });
        EntityEvent event = EntityEvent.of(entity, FiwareScope.DEFAULT, RECEIVED, SKEW, Origin.NOTIFICATION);
        assertThat(event.time().time()).isBetween(Instant.EPOCH, RECEIVED.plus(SKEW));
        assertThat(event.headers("/test")).doesNotContainValue(null);
        assertThat(event.id()).matches("[0-9a-f]{32}");
    }

    private byte[] mutated(byte[] body) {
        String text = new String(body, StandardCharsets.UTF_8);
        for (int changes = 1 + random.nextInt(3); changes > 0; changes--) {
            text = switch (random.nextInt(10)) {
                case 0, 1, 2, 3 -> replaceValue(text);
                case 4, 5, 6 -> rename(text);
                case 7 -> text.substring(0, random.nextInt(text.length() + 1));
                default -> text;
            };
        }
        byte[] bytes = text.getBytes(StandardCharsets.UTF_8);
        if (bytes.length > 0 && random.nextInt(5) == 0) {
            bytes[random.nextInt(bytes.length)] = (byte) random.nextInt(256);
        }
        return bytes;
    }

    /** A value (what follows a colon up to the next sign of structure) becomes another. */
    private String replaceValue(String text) {
        List<Integer> colons = new ArrayList<>();
        for (int at = text.indexOf("\":"); at >= 0; at = text.indexOf("\":", at + 1)) {
            colons.add(at + 2);
        }
        if (colons.isEmpty()) {
            return text;
        }
        int from = colons.get(random.nextInt(colons.size()));
        int to = from;
        while (to < text.length() && ",}]".indexOf(text.charAt(to)) < 0) {
            to++;
        }
        boolean container = from < text.length() && "{[".indexOf(text.charAt(from)) >= 0;
        return text.substring(0, from)
                + SPLICES[random.nextInt(SPLICES.length)]
                + text.substring(container ? closing(text, from) : to);
    }

    private static int closing(String text, int open) {
        int depth = 0;
        for (int at = open; at < text.length(); at++) {
            depth += "{[".indexOf(text.charAt(at)) >= 0 ? 1 : "}]".indexOf(text.charAt(at)) >= 0 ? -1 : 0;
            if (depth == 0) {
                return at + 1;
            }
        }
        return text.length();
    }

    private String rename(String text) {
        String from = random.nextBoolean() ? "moisture" : "temperature";
        return text.replaceFirst("\"" + from + "\":", "\"" + NAMES[random.nextInt(NAMES.length)] + "\":");
    }
}
