package io.furrow.model.topic;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;

class TopicNameTest {
    private static final long SEED = 20261121;
    private static final String[] PARTS = {
        "a", "b", "A", "_", "-", ".", "_realtime", "realtime", "dead",
        "_dead", "_x-", "_h-", "-2E", "é", "", " ", "raw", "2E"
    };

    @ParameterizedTest
    @ValueSource(strings = {"canary", "Field_7", "a-b", "0", "realtime", "undead", "dead_", "_x", "x_h-"})
    void keepsLegalNames(String name) {
        assertThat(TopicName.of(name)).isEqualTo(name);
        assertThat(TopicName.isLegal(name)).isTrue();
    }

    @ParameterizedTest
    @CsvSource({
        "field.7, _x-field-2E7", "'', _x-", "ñ, _x--C3-B1", "'a b', _x-a-20b",
        "'a\n', _x-a-0A", "_x-a, _x--5Fx-2Da", "_h-a, _x--5Fh-2Da", "a_realtime, _x-a-5Frealtime",
        "dead, _x-dead", "un_dead, _x-un-5Fdead"
    })
    void encodesOtherNames(String name, String expected) {
        assertThat(TopicName.of(name)).isEqualTo(expected);
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "a", "field.7", "ñandú 🚜", "_x-a", "_h-a",
                "dead", "a_realtime_b", " ", "a-2Eb", "%",
                "_x-field-2E7"
            })
    void decodesNames(String name) {
        assertThat(TopicName.original(TopicName.of(name))).contains(name);
    }

    @ParameterizedTest
    @ValueSource(strings = {"_x-a", "_x-field-2e7", "_x-a-", "_x-a-ZZ", "_h-00", "a.b", "dead"})
    void decodesNothingThatIsNotAnEncoding(String part) {
        assertThat(TopicName.original(part)).isEmpty();
    }

    @Test
    void hashesLongNames() {
        assertThat(TopicName.of("x".repeat(64))).isEqualTo("x".repeat(64));
        assertThat(TopicName.of("x".repeat(65))).isEqualTo("_x-" + "x".repeat(65));
        assertThat(TopicName.of("x".repeat(97))).hasSize(100);
        assertThat(TopicName.of("x".repeat(98))).matches("_h-[0-9a-f]{64}");
    }

    /** Kafka's rules for topics: its alphabet, 249 characters, and no two that differ only in '.' and '_'. */
    @Tag("full")
    @Test
    void givesNoTwoNamesTopicsThatCollideInKafka() {
        Map<String, String> ownerOf = new HashMap<>();
        List<String> names = names();
        for (String domain : names) {
            claim(ownerOf, Topics.realtime(domain), "domain " + domain);
            claim(ownerOf, Topics.dead(Topics.realtime(domain)), "dead of domain " + domain);
            for (String mission : names) {
                claim(ownerOf, Topics.realtime(domain, mission), "mission " + domain + " / " + mission);
                String dead = Topics.dead(Topics.realtime(domain, mission));
                claim(ownerOf, dead, "dead of mission " + domain + " / " + mission);
            }
        }
        for (String topic : List.of(Topics.RAW, Topics.TEMPERATURE, Topics.COLLISION, Topics.COLLISION_LATE)) {
            claim(ownerOf, topic, topic);
            claim(ownerOf, Topics.dead(topic), "dead of " + topic);
        }
        assertThat(ownerOf.size()).isGreaterThan(names.size() * names.size());
    }

    private static void claim(Map<String, String> ownerOf, String topic, String owner) {
        assertThat(topic).matches("[A-Za-z0-9._-]{1,249}");
        String other = ownerOf.put(topic.replace('.', '_'), owner);
        assertThat(other)
                .as("seed %d: %s has the topic of %s: %s", SEED, owner, other, topic)
                .isNull();
    }

    private static List<String> names() {
        Random random = new Random(SEED);
        List<String> names =
                new ArrayList<>(List.of("x".repeat(300), "x".repeat(64), "y".repeat(5000), "é".repeat(20)));
        while (names.size() < 250) {
            StringBuilder name = new StringBuilder();
            for (int parts = random.nextInt(5); parts >= 0; parts--) {
                name.append(PARTS[random.nextInt(PARTS.length)]);
            }
            if (!names.contains(name.toString())) {
                names.add(name.toString());
            }
        }
        return names;
    }
}
