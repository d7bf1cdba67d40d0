package io.furrow.model.ngsi;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.Stream;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.MethodSource;
import org.junit.jupiter.params.provider.NullSource;
import org.junit.jupiter.params.provider.ValueSource;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.catchThrowableOfType;

class NotificationTest {
    static Stream<RecordedNotification> named() {
        return RecordedNotification.all().stream()
                .filter(each -> !each.attrsFormat().equals("values"));
    }

    static Stream<RecordedNotification> nameless() {
        return RecordedNotification.all().stream()
                .filter(each -> each.attrsFormat().equals("values"));
    }

    @ParameterizedTest
    @MethodSource("named")
    void readsNotificationsOfOrion(RecordedNotification recorded) throws Exception {
        Notification notification = Notification.read(recorded.body(), recorded.attrsFormat());

        assertThat(notification.rejected()).isEmpty();
        assertThat(notification.entities()).singleElement().isEqualTo(golden(recorded));
    }

    @ParameterizedTest
    @MethodSource("named")
    void detectsTheRepresentationWithoutAHeader(RecordedNotification recorded) throws Exception {
        assertThat(Notification.read(recorded.body(), null).entities()).containsExactly(golden(recorded));
    }

    @ParameterizedTest
    @MethodSource("named")
    void namesTheSubscriptionIfTheRepresentationDoes(RecordedNotification recorded) throws Exception {
        boolean bare = recorded.attrsFormat().startsWith("simplified");

        assertThat(Notification.read(recorded.body(), recorded.attrsFormat()).subscriptionId())
                .matches(subscription -> subscription.isEmpty() == bare)
                .isNotEqualTo(java.util.Optional.of(""));
    }

    @ParameterizedTest
    @MethodSource("nameless")
    void rejectsTheRepresentationWithoutAttributeNames(RecordedNotification recorded) {
        for (String header : new String[] {"values", null}) {
            UnreadableException rejection = unreadable(new String(recorded.body(), UTF_8), header);

            assertThat(rejection.reason()).isEqualTo(Reason.UNSUPPORTED_FORM);
            assertThat(rejection).hasMessageContainingAll("attrsFormat", "normalized");
        }
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            legacy | {"subscriptionId":"5f1","originator":"localhost","contextResponses":[{"contextElement":{"id":"a","type":"T","isPattern":"false","attributes":[]},"statusCode":{"code":"200"}}]}
                   | {"contextResponses":[{"contextElement":{"id":"a"}}]}
            legacy | {"subscriptionId":"5f1","contextResponses":[]}
            """)
    void rejectsTheRepresentationOfNgsiV1(String header, String body) {
        UnreadableException rejection = unreadable(body, header);

        assertThat(rejection.reason()).isEqualTo(Reason.UNSUPPORTED_FORM);
        assertThat(rejection).hasMessageContainingAll("NGSIv1", "set the subscription's attrsFormat to normalized");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            simplifiedNormalized | {"id":"a","data":{"type":"Text","value":"x","metadata":{}}}
            simplifiedKeyValues  | {"id":"a","data":"x"}
                                 | {"id":"a","data":"x"}
            keyValues            | {"id":"a","data":"x"}
            """)
    void readsABareEntityWithAnAttributeNamedData(String header, String body) throws Exception {
        Notification notification = Notification.read(bytes(body), header);

        assertThat(notification.entities())
                .singleElement()
                .satisfies(entity -> assertThat(entity.text("data")).contains("x"));
    }

    @Test
    void keepsAnObjectWithAMemberNamedValueInKeyValues() throws Exception {
        String body = "{\"id\":\"a\",\"speed\":{\"value\":3,\"type\":\"Number\"}}";

        Entity keyValues = only(body, "simplifiedKeyValues");
        Entity normalized = only(body, "simplifiedNormalized");

        assertThat(keyValues.value("speed").orElseThrow()).isEqualTo(json("{\"value\":3,\"type\":\"Number\"}"));
        assertThat(normalized.value("speed").orElseThrow()).isEqualTo(json("3"));
    }

    @Test
    void readsAnObjectWithAnUnknownMemberAsAValue() throws Exception {
        Entity entity = only("{\"id\":\"a\",\"speed\":{\"value\":3,\"unit\":\"m/s\"}}", null);

        assertThat(entity.value("speed").orElseThrow()).isEqualTo(json("{\"value\":3,\"unit\":\"m/s\"}"));
    }

    @Test
    void isUnreadableWithTooManyUnreadableEntities() throws Exception {
        String many = "0,".repeat(Notification.MAX_REJECTED - 1);

        assertThat(Notification.read(bytes("{\"data\":[" + many + "0]}"), null).rejected())
                .hasSize(Notification.MAX_REJECTED);
        UnreadableException rejection = unreadable("{\"data\":[" + many + "0,{\"id\":\"a\"},0]}", null);

        assertThat(rejection.reason()).isEqualTo(Reason.NOT_AN_ENTITY);
        assertThat(rejection).hasMessageContaining("more than " + Notification.MAX_REJECTED);
        assertThat(rejection.getStackTrace()).isEmpty();
    }

    @Test
    void readsTheOtherEntitiesBesideAnUnreadableOne() throws Exception {
        String body = "{\"data\":[{\"id\":\"a\"},{\"id\":7},3,{\"id\":\"b\",\"type\":3},[],{\"id\":\"c\"}]}";

        Notification notification = Notification.read(bytes(body), "keyValues");

        assertThat(notification.entities()).extracting(Entity::id).containsExactly("a", "c");
        assertThat(notification.rejected())
                .extracting(Notification.Rejected::reported)
                .extracting(Object::toString)
                .containsExactly("{\"id\":7}", "3", "{\"id\":\"b\",\"type\":3}", "[]");
        assertThat(notification.rejected())
                .extracting(Notification.Rejected::reason)
                .containsOnly(Reason.NOT_AN_ENTITY);
    }

    @ParameterizedTest
    @CsvSource({
        "21.5, Number", "'\"a\"', Text", "true, Boolean",
        "null, None", "[1], StructuredValue", "{}, StructuredValue",
        "'{\"type\":\"Point\",\"coordinates\":[1,2]}', geo:json"
    })
    void assignsTheTypeOfTheContextBrokerToAnAttributeWithoutOne(String value, String type) throws Exception {
        String expected = "{\"type\":\"" + type + "\",\"value\":" + value + ",\"metadata\":{}}";

        assertThat(only("{\"id\":\"a\",\"x\":" + value + "}", "simplifiedKeyValues")
                        .json()
                        .get("x"))
                .isEqualTo(json(expected));
        assertThat(only("{\"id\":\"a\",\"x\":{\"value\":" + value + ",\"metadata\":7,\"type\":1}}", "normalized")
                        .json()
                        .get("x"))
                .isEqualTo(json(expected));
    }

    @ParameterizedTest
    @NullSource
    @ValueSource(strings = {"normalized", "keyValues", "simplifiedNormalized", "simplifiedKeyValues", "legacy"})
    void rejectsBodiesWithoutAnEntity(String header) {
        for (String body : List.of("[]", "3", "null", "{}", "{\"id\":\" \"}", "{\"id\":\"a\",\"type\":3}")) {
            assertThat(unreadable(body, header).reason()).as(body).isEqualTo(Reason.NOT_AN_ENTITY);
        }
        assertThat(unreadable("{\"data\":{}}", header).reason()).isEqualTo(Reason.NOT_AN_ENTITY);
    }

    @Test
    void rejectsANormalizedAttributeWithoutAValue() {
        assertThatThrownBy(
                        () -> Notification.read(bytes("{\"id\":\"a\",\"x\":{\"type\":\"T\"}}"), "simplifiedNormalized"))
                .isInstanceOf(UnreadableException.class)
                .hasMessageContaining("'x'");
    }

    private static Entity golden(RecordedNotification recorded) throws IOException, UnreadableException {
        return Entity.parse(Files.readAllBytes(Path.of("src/test/resources/golden", recorded.name() + ".json")));
    }

    private static Entity only(String body, String header) throws UnreadableException {
        return Notification.read(bytes(body), header).entities().get(0);
    }

    private static UnreadableException unreadable(String body, String header) {
        return catchThrowableOfType(UnreadableException.class, () -> Notification.read(bytes(body), header));
    }

    private static com.fasterxml.jackson.databind.JsonNode json(String text) throws UnreadableException {
        return NgsiJson.read(bytes(text));
    }

    private static byte[] bytes(String text) {
        return text.getBytes(UTF_8);
    }
}
