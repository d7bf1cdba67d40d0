package io.furrow.connect.subscription;

import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.connect.subscription.DesiredSubscription.Name;
import io.furrow.connect.subscription.DesiredSubscription.Throttling;
import io.furrow.connect.subscription.SubscriptionPlan.Step;
import io.furrow.model.event.FiwareScope;

import static org.assertj.core.api.Assertions.assertThat;

class SubscriptionPlanTest {
    private static final Instant NOW = Instant.parse("2026-11-21T12:00:00Z");
    private static final NotificationContent CONTENT =
            new NotificationContent(List.of("*", "dateModified"), "normalized", false);
    private static final Target TARGET = new Target("http://here:8090/v2/notify", Map.of(), Optional.empty());
    private static final DesiredSubscription WANTED = desired(IdPartition.ALL, TARGET, Throttling.EVERY_CHANGE);

    @Test
    void makesWhatIsNotThere() {
        SubscriptionPlan plan = SubscriptionPlan.of(WANTED, List.of(shown("1", "another's", TARGET.url())), NOW);

        assertThat(plan.current()).isEmpty();
        assertThat(plan.steps())
                .singleElement()
                .isInstanceOfSatisfying(
                        Step.Create.class, create -> assertThat(create.json()).hasToString("""
                        {"description":"furrow farm 1/1","subject":{"entities":[{"idPattern":".*"}]},\
                        "notification":{"attrs":["*","dateModified"],"attrsFormat":"normalized","onlyChangedAttrs":false,\
                        "http":{"url":"http://here:8090/v2/notify"}}}"""));
    }

    @Test
    void changesOneThatTellsOtherMetadata() {
        NotificationContent notificationContent = new NotificationContent(
                List.of("*", "dateModified"), List.of("*", "dateModified"), "normalized", false);
        DesiredSubscription desired = new DesiredSubscription(
                WANTED.name(), WANTED.subject(), notificationContent, TARGET, Throttling.EVERY_CHANGE);

        assertThat(SubscriptionPlan.of(desired, List.of(ours()), NOW).steps())
                .singleElement()
                .isInstanceOfSatisfying(Step.Change.class, change -> {
                    assertThat(change.members()).containsExactly("metadata");
                    assertThat(change.json().at("/notification/metadata")).hasToString("[\"*\",\"dateModified\"]");
                });
    }

    @Test
    void leavesAloneWhatIsAsItShouldBe() {
        assertThat(SubscriptionPlan.of(WANTED, List.of(ours()), NOW).steps()).isEmpty();
    }

    static Stream<Arguments> differences() {
        return Stream.of(
                Arguments.of("/status", "\"inactive\"", "status"),
                Arguments.of("/status", "\"failed\"", "status"),
                Arguments.of("/status", "\"expired\"", "status"),
                Arguments.of("/expires", "\"2026-11-22T12:00:00.000Z\"", "expires"),
                Arguments.of("/throttling", "5", "throttling"),
                Arguments.of("/subject/entities/0/idPattern", "\"a\"", "entities"),
                Arguments.of("/subject/entities/0/type", "\"Probe\"", "entities"),
                Arguments.of("/subject/condition/attrs", "[\"t\"]", "condition.attrs"),
                Arguments.of("/subject/condition/alterationTypes", "[\"entityCreate\"]", "alterationTypes"),
                Arguments.of("/subject/condition/expression", "{\"q\": \"t>1\"}", "expression"),
                Arguments.of("/notification/http/url", "\"http://there/\"", "url"),
                Arguments.of("/notification/attrs", "[]", "attrs"),
                Arguments.of("/notification/exceptAttrs", "[\"image\"]", "exceptAttrs"),
                Arguments.of("/notification/metadata", "[\"*\"]", "metadata"),
                Arguments.of("/notification/attrsFormat", "\"keyValues\"", "attrsFormat"),
                Arguments.of("/notification/onlyChangedAttrs", "true", "onlyChangedAttrs"),
                Arguments.of("/notification/maxFailsLimit", "3", "maxFailsLimit"));
    }

    @ParameterizedTest
    @MethodSource("differences")
    void changesOnlyWhatDiffers(String where, String value, String member) throws Exception {
        ObjectNode ours = ours();
        int slash = where.lastIndexOf('/');
        ((ObjectNode) ours.at(where.substring(0, slash))).set(where.substring(slash + 1), json(value));

        SubscriptionPlan plan = SubscriptionPlan.of(WANTED, List.of(ours), NOW);

        assertThat(plan.steps()).singleElement().isInstanceOfSatisfying(Step.Change.class, change -> {
            assertThat(change.members()).isEqualTo(Set.of(member));
            assertThat(change.json()).hasSize(1);
        });
    }

    @Test
    void tellsOfASecretThatIsNotTheSameAndDoesNotShowIt() {
        Target secret = new Target(TARGET.url(), Map.of("X-Secret", "s3cret"), Optional.of(3));
        DesiredSubscription guarded = desired(IdPartition.ALL, secret, Throttling.EVERY_CHANGE);

        SubscriptionPlan plan = SubscriptionPlan.of(guarded, List.of(ours()), NOW);

        Step.Change change = (Step.Change) plan.steps().get(0);
        assertThat(change.members()).isEqualTo(Set.of("headers", "maxFailsLimit"));
        assertThat(change.json().at("/notification/httpCustom")).hasToString("""
                {"url":"http://here:8090/v2/notify","headers":{"X-Secret":"s3cret"}}""");
        assertThat(guarded.toString()).doesNotContain("s3cret");
    }

    @ParameterizedTest
    @CsvSource({"2026-11-21T12:10:00Z, true", "2026-11-21T12:50:00Z, false", "2026-11-21T15:00:00Z, true", "'', true"})
    void renewsTheEndWhenHalfOfItsLifeIsGone(String end, boolean renewed) {
        DesiredSubscription mortal =
                desired(IdPartition.ALL, TARGET, new Throttling(Duration.ZERO, Optional.of(Duration.ofHours(1))));
        ObjectNode ours = end.isEmpty() ? ours() : ours().put("expires", end);

        SubscriptionPlan plan = SubscriptionPlan.of(mortal, List.of(ours), NOW);

        assertThat(plan.steps()).hasSize(renewed ? 1 : 0);
        if (renewed) {
            assertThat(((Step.Change) plan.steps().get(0)).json())
                    .hasToString("{\"expires\":\"2026-11-21T13:00:00Z\"}");
        }
    }

    @Test
    void removesASecondOneAndKeepsTheOneWithOurAddress() {
        ObjectNode moved = shown("1", "furrow farm 1/1", "http://there:8090/v2/notify");
        ObjectNode ours = shown("2", "furrow farm 1/1", TARGET.url());

        SubscriptionPlan plan = SubscriptionPlan.of(WANTED, List.of(moved, ours), NOW);

        assertThat(plan.current()).contains(ours);
        assertThat(plan.steps()).containsExactly(new Step.Remove("1", "furrow farm 1/1"));
    }

    @Test
    void removesThoseOfAnotherNumberOfTasksWhenAllOfThisNumberAreThere() {
        ObjectNode former = shown("9", "furrow farm 1/1", TARGET.url());
        DesiredSubscription first = desired(new IdPartition(0, 2), TARGET, Throttling.EVERY_CHANGE);
        DesiredSubscription second = desired(new IdPartition(1, 2), TARGET, Throttling.EVERY_CHANGE);
        JsonNode one = first.json(NOW).put("id", "1").put("status", "active");
        JsonNode two = second.json(NOW).put("id", "2").put("status", "active");
        JsonNode foreign = shown("3", "furrow farm elsewhere 1/1", TARGET.url());

        assertThat(SubscriptionPlan.of(first, List.of(former, one), NOW).steps())
                .isEmpty();
        assertThat(SubscriptionPlan.of(second, List.of(former, one, two), NOW).steps())
                .isEmpty();
        assertThat(SubscriptionPlan.of(first, List.of(former, one, two, foreign), NOW)
                        .steps())
                .containsExactly(new Step.Remove("9", "furrow farm 1/1"));
        assertThat(SubscriptionPlan.of(second, List.of(former, one), NOW).leftovers())
                .containsExactly(former);
    }

    private static DesiredSubscription desired(IdPartition partition, Target target, Throttling throttling) {
        Subject subject = new Subject(partition.pattern(), List.of(), Optional.empty(), List.of());
        return new DesiredSubscription(
                new Name("furrow farm", partition, new FiwareScope("", "/#")), subject, CONTENT, target, throttling);
    }

    private static ObjectNode ours() {
        return shown("1", "furrow farm 1/1", TARGET.url());
    }

    /** As Orion shows it, with what it adds. */
    private static ObjectNode shown(String id, String description, String url) {
        ObjectNode shown = desired(
                        IdPartition.ALL, new Target(url, Map.of(), Optional.empty()), Throttling.EVERY_CHANGE)
                .json(NOW)
                .put("id", id)
                .put("status", "active")
                .put("description", description);
        ((ObjectNode) shown.get("subject")).putObject("condition").putArray("attrs");
        ((ObjectNode) shown.get("notification"))
                .put("timesSent", 7)
                .put("lastSuccess", "2026-11-21T11:59:00.000Z")
                .put("lastSuccessCode", 200);
        return shown;
    }

    private static JsonNode json(String text) throws Exception {
        return io.furrow.model.ngsi.NgsiJson.mapper().readTree(text);
    }
}
