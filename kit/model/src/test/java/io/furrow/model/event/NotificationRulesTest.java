package io.furrow.model.event;

import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.regex.Pattern;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Notification;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class NotificationRulesTest {
    private static final Instant NOW = Instant.parse("2026-11-21T02:00:00Z");
    private static final FiwareScope SCOPE = FiwareScope.of("farm", "/");
    private static final NotificationRules RULES = new NotificationRules(
            "fallback",
            List.of(Pattern.compile("Analytics:.*"), Pattern.compile("Domain")),
            EventTimeRule.within(Duration.ofMinutes(5)),
            Origin.NOTIFICATION);

    @Test
    void createsARecordOfAChange() {
        EntityRecord record = record(reported(-60));

        assertThat(record.key()).isEqualTo("a");
        assertThat(record.value()).isNotEmpty();
        assertThat(record.time()).isEqualTo(NOW.minusSeconds(60));
        assertThat(record.headers())
                .containsEntry(HeaderNames.CE_SOURCE, "/ngsi/5f1")
                .containsKey(HeaderNames.CE_ID);
        assertThat(record.fault()).isNull();
    }

    @Test
    void createsARecordWithoutValueOfADeletion() throws UnreadableException {
        Notification notification = notification("""
                {"subscriptionId": "5f1", "data": [{"id": "a", "type": "T", "alterationType": {"type": "Text", "value": "entityDelete"}}]}""");

        EntityRecord record = record(notification.entities().get(0));

        assertThat(record.value()).isNull();
        assertThat(record.fault()).isNull();
    }

    /** Unreadable entities have a position, too. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            /      | {'id':'a'},{'id':'b'}                                  | / /
            /n     | {'id':'a'},{'id':'b'}                                  | /n /n
            /a,/b  | {'id':'a'},{'id':'b'}                                  | /a /b
            /a, /b | {'id':'a'},{'id':'b'}                                  | /a /b
            /,/    | {'id':'a'},{'id':'b'}                                  | / /
            /a,/b,/c | {'id':'a'},{'id':5},{'id':'b'}                       | /a /c
            /,/    | {'id':'a'}                                             | /
            /a,/a/ | {'id':'a'}                                             | /a
            /a,/b  | {'id':'a'}                                             | -
            /a,/b  | {'id':'a'},{'id':'b'},{'id':'c'}                       | - - -
            /a,/b  | {'id':'a','servicePath':{'type':'Text','value':'/t'}},{'id':'b'} | /t /b
            /a,/b  | {'id':'a','servicePath':{'type':'Text','value':'/t'}}  | /t
            /n     | {'id':'a','servicePath':{'type':'Text','value':'/t'}}  | /n
            /a,/b  | {'id':'a','servicePath':{'type':'Text','value':'no path'}},{'id':'b'} | /a /b
            """)
    void givesEachEntityItsServicePath(String header, String entities, String paths) throws Exception {
        Notification notification =
                notification("{\"subscriptionId\": \"5f1\", \"data\": [%s]}".formatted(entities.replace('\'', '"')));

        List<String> found = new ArrayList<>();
        for (int i = 0; i < notification.entities().size(); i++) {
            try {
                found.add(NotificationRules.scope(notification, i, FiwareScope.of("farm", header))
                        .servicePath());
            } catch (UnreadableException e) {
                assertThat(e).hasMessageContainingAll("has no service path", header);
                found.add("-");
            }
        }

        assertThat(found).containsExactly(paths.split(" "));
    }

    @Test
    void reportsAClockThatIsTooFarAhead() {
        assertThat(record(reported(10)).fault()).isNull();
        assertThat(record(reported(600)).fault()).isEqualTo(EventTime.Fault.AHEAD);
        assertThat(record(reported(600)).time()).isEqualTo(NOW);
    }

    @Test
    void excludesTypesThatMatchAsAWhole() {
        assertThat(RULES.excludes(Entity.builder("a", "Analytics:Collision").build()))
                .isTrue();
        assertThat(RULES.excludes(Entity.builder("a", "Domain").build())).isTrue();
        assertThat(RULES.excludes(Entity.builder("a", "DomainOfSomebody").build()))
                .isFalse();
    }

    @Test
    void namesTheSubscriptionOrTheSource() throws UnreadableException {
        assertThat(RULES.source(notification("{\"subscriptionId\": \"5f1\", \"data\": []}")))
                .isEqualTo("/ngsi/5f1");
        assertThat(RULES.source(notification("{\"subscriptionId\": \"a b\", \"data\": []}")))
                .isEqualTo("/ngsi/fallback");
        assertThat(RULES.source(notification("{\"data\": []}"))).isEqualTo("/ngsi/fallback");
    }

    private static EntityRecord record(Entity entity) {
        return RULES.record(entity, SCOPE, NOW, "/ngsi/5f1");
    }

    private static Entity reported(long secondsAhead) {
        return Entity.builder("a", "T")
                .integer("Time", NOW.plusSeconds(secondsAhead).toEpochMilli())
                .build();
    }

    private static Notification notification(String json) throws UnreadableException {
        return Notification.read(json.getBytes(UTF_8), null);
    }
}
