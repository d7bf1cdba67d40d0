package io.furrow.model.event;

import java.time.Instant;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.ngsi.Notification;
import io.furrow.model.ngsi.RecordedNotification;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class EventIdTest {
    private static final Instant TIME = Instant.ofEpochMilli(1_700_000_000_000L);
    private static final FiwareScope SCOPE = FiwareScope.of("agri", "/plot1");

    @Test
    void staysTheSameInAllReleases() throws Exception {
        assertThat(id("{\"id\":\"a\",\"x\":1,\"y\":[null,true,{\"z\":\"t\"}]}"))
                .isEqualTo("3a28f96ce5b8ff3c8901b7b73ed1723e");
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "{\"id\":\"a\",\"y\":\"t\",\"x\":18}",
                "{\"id\":\"a\",\"x\":18.0,\"y\":\"t\"}",
                "{\"id\":\"a\",\"x\":1.8e1,\"y\":\"t\"}",
                "{\"id\":\"a\",\"x\":18,\"y\":\"\\u0074\"}",
                "{\"id\":\"a\",\"x\":18,\"y\":\"t\",\"dateModified\":\"never\",\"dateCreated\":1}",
                "{\"id\":\"a\",\"x\":18,\"y\":\"t\",\"servicePath\":\"/b\",\"alterationType\":1,\"dateExpires\":1}"
            })
    void ignoresDifferencesBetweenNotificationsOfOneChange(String body) throws Exception {
        assertThat(id(body)).isEqualTo(id("{\"id\":\"a\",\"x\":18,\"y\":\"t\"}"));
    }

    @ParameterizedTest
    @ValueSource(strings = {"create", "patch", "forced"})
    void isTheSameInAllRepresentationsOfOneChange(String cause) throws Exception {
        List<String> forms = List.of("normalized", "keyValues", "simplifiedNormalized", "simplifiedKeyValues");

        assertThat(forms.stream().map(form -> id(RecordedNotification.named(cause + "/" + form))))
                .hasSize(forms.size())
                .containsOnly(id(RecordedNotification.named(cause + "/normalized")));
        assertThat(id(RecordedNotification.named("create/normalized")))
                .isNotEqualTo(id(RecordedNotification.named("patch/normalized")));
    }

    @Test
    void ignoresTheOrderOfMembersInsideAValueButNotOfElements() throws Exception {
        assertThat(id("{\"id\":\"a\",\"x\":{\"p\":1,\"q\":2}}"))
                .isEqualTo(id("{\"id\":\"a\",\"x\":{\"q\":2,\"p\":1}}"));
        assertThat(id("{\"id\":\"a\",\"x\":[1,2]}")).isNotEqualTo(id("{\"id\":\"a\",\"x\":[2,1]}"));
    }

    @Test
    void ignoresTypesAndMetadata() throws Exception {
        Entity bare = Entity.parse(utf8("{\"id\":\"a\",\"x\":{\"value\":1}}"));
        Entity rich = Entity.parse(
                utf8("{\"id\":\"a\",\"x\":{\"type\":\"Q\",\"value\":1,\"metadata\":{\"unit\":{\"value\":\"m\"}}}}"));

        assertThat(EventId.of(SCOPE, rich, TIME)).isEqualTo(EventId.of(SCOPE, bare, TIME));
    }

    @Test
    void differsForEveryPartOfAnEvent() throws Exception {
        Entity entity = entity("{\"id\":\"a\",\"x\":1}");

        assertThat(List.of(
                        EventId.of(SCOPE, entity, TIME),
                        EventId.of(FiwareScope.of("other", "/plot1"), entity, TIME),
                        EventId.of(FiwareScope.of("agri", "/plot2"), entity, TIME),
                        EventId.of(FiwareScope.of("agri/", "plot1"), entity, TIME),
                        EventId.of(SCOPE, entity, TIME.plusMillis(1)),
                        EventId.of(SCOPE, entity("{\"id\":\"a\",\"type\":\"Pump\",\"x\":1}"), TIME),
                        EventId.of(SCOPE, entity("{\"id\":\"b\",\"x\":1}"), TIME)))
                .doesNotHaveDuplicates();
    }

    /** One program computes the id from numbers, another from the JSON that the first has written. */
    @ParameterizedTest
    @ValueSource(
            doubles = {
                0.0,
                -0.0,
                1,
                120,
                -7.25,
                1e-3,
                9.99e-4,
                1e7,
                9999999.5,
                1e-7,
                2e-3,
                1e23,
                2.2250738585072014E-308,
                Double.MAX_VALUE,
                Double.MIN_VALUE,
                0.7326269432769902,
                -3.395899191885078,
                1.0000000000000002
            })
    void isTheSameBeforeAndAfterWriting(double number) throws Exception {
        EntityBuilder built = Entity.builder("a", "T").text("t", "é").number("x", number);

        assertThat(built.toBytes()).isEqualTo(built.build().toBytes());
        assertThat(EventId.of(SCOPE, built, TIME))
                .isEqualTo(EventId.of(SCOPE, built.build(), TIME))
                .isEqualTo(EventId.of(SCOPE, Entity.parse(built.toBytes()), TIME));
    }

    /** These pairs would have the same encoding without lengths, counts or kinds. */
    @Test
    void differsForEveryValue() throws Exception {
        Map<String, String> seen = new HashMap<>();
        for (String attributes : List.of(
                "\"x\":1",
                "\"x\":\"1\"",
                "\"x\":\"#1\"",
                "\"x\":[1]",
                "\"x\":[[1]]",
                "\"x\":[]",
                "\"x\":{}",
                "\"x\":[[]]",
                "\"x\":[{}]",
                "\"x\":null",
                "\"x\":\"null\"",
                "\"x\":\"\"",
                "\"x\":true",
                "\"x\":\"true\"",
                "\"x\":false",
                "\"x\":0",
                "\"x\":1e20",
                "\"x\":1e-20",
                "\"x\":100000000000000000001",
                "\"x\":0.1",
                "\"x\":0.1000000000000000000001",
                "\"x\":[1,2]",
                "\"x\":[12]",
                "\"x\":[[1],2]",
                "\"x\":[[1,2]]",
                "\"x\":{\"p\":1}",
                "\"x\":[\"p\",1]",
                "\"x\":{\"p\":{\"q\":1}}",
                "\"x\":{\"p\":{},\"q\":1}",
                "\"x\":1,\"y\":1",
                "\"x\":\"1\\\"1:y#1\"",
                "\"xy\":1",
                "\"x\":\"y1\"",
                "\"x\":\"a\",\"y\":\"b\"",
                "\"x\":\"a\\\"1:y\\\"1:b\"",
                "\"x\":\"é\"",
                "\"x\":\"e\\u0301\"",
                "\"x\":\"?\"",
                "\"x\":\"🚜\"")) {
            String other = seen.put(id("{\"id\":\"a\"," + attributes + "}"), attributes);
            assertThat(other).as("has the id of %s", attributes).isNull();
        }
    }

    private static String id(RecordedNotification recorded) {
        try {
            return EventId.of(
                    SCOPE,
                    Notification.read(recorded.body(), recorded.attrsFormat())
                            .entities()
                            .get(0),
                    TIME);
        } catch (UnreadableException e) {
            throw new AssertionError(recorded.name(), e);
        }
    }

    private static String id(String keyValues) throws UnreadableException {
        return EventId.of(SCOPE, entity(keyValues), TIME);
    }

    private static Entity entity(String keyValues) throws UnreadableException {
        return Notification.read(utf8(keyValues), "simplifiedKeyValues")
                .entities()
                .get(0);
    }

    private static byte[] utf8(String text) {
        return text.getBytes(UTF_8);
    }
}
