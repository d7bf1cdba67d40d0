package io.furrow.connect.source.notification;

import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.regex.Pattern;

import org.apache.logging.log4j.Level;
import org.apache.logging.log4j.LogManager;
import org.apache.logging.log4j.core.LogEvent;
import org.apache.logging.log4j.core.Logger;
import org.apache.logging.log4j.core.appender.AbstractAppender;
import org.apache.logging.log4j.core.config.Configurator;
import org.apache.logging.log4j.core.config.Property;
import org.junit.jupiter.api.Test;

import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.EventTimeRule;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Reason;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class NotificationTranslatorTest {
    private static final Instant NOW = Instant.parse("2026-11-21T02:00:00Z");
    private static final int RECORD_LIMIT = 200_000;
    private static final long NOTIFICATION_LIMIT = 1_000_000;

    private final Ledger ledger = new Ledger();
    private final NotificationTranslator translator = new NotificationTranslator(
            new NotificationTranslator.Settings(
                    "farm",
                    "raw",
                    "raw.dead",
                    List.of(Pattern.compile("Analytics:.*"), Pattern.compile("Domain")),
                    EventTimeRule.within(Duration.ofMinutes(5)),
                    RECORD_LIMIT,
                    NOTIFICATION_LIMIT),
            ledger);

    @Test
    void countsEntitiesWithoutDateModified() {
        translate("""
                {"subscriptionId": "5f1", "data": [{"id": "a", "type": "T", "x": 1}, {"id": "b", "type": "T", "x": 2}]}""");
        translate("""
                {"subscriptionId": "5f1", "data": [{"id": "a", "dateModified": "2026-11-21T01:59:00Z"}]}""");
        assertThat(ledger.undated.sum()).isEqualTo(2);
        assertThat(ledger.accepted.sum()).isEqualTo(3);
    }

    @Test
    void makesOneRecordPerEntityUnderItsIdAtItsEventTime() {
        Translation translation = translate("""
                {"subscriptionId": "5f1", "data": [{"id": "a", "type": "T", "x": 1, "TimeInstant": "2026-11-21T01:59:00Z"},
                 {"id": "b", "type": "T", "x": 2}]}""");

        assertThat(translation.refusal()).isEmpty();
        assertThat(translation.records()).extracting(KafkaRecord::key).containsExactly("a", "b");
        assertThat(translation.records()).extracting(KafkaRecord::topic).containsOnly("raw");
        KafkaRecord first = translation.records().get(0);
        assertThat(first.time()).isEqualTo("2026-11-21T01:59:00Z");
        assertThat(text(first)).contains("\"x\":{\"type\":\"Number\",\"value\":1,\"metadata\":{}}");
        assertThat(first.headers())
                .containsEntry(HeaderNames.CE_SOURCE, "/ngsi/5f1")
                .containsEntry(HeaderNames.SERVICE, "agri")
                .containsEntry(HeaderNames.SERVICE_PATH, "/plot1")
                .containsEntry(HeaderNames.ORIGIN, "notification");
        assertThat(ledger.accepted.sum()).isEqualTo(2);
    }

    @Test
    void namesTheConnectorWhereNoUsableSubscriptionIsNamed() {
        assertThat(translate("{\"id\": \"a\", \"type\": \"T\"}")
                        .records()
                        .get(0)
                        .headers())
                .containsEntry(HeaderNames.CE_SOURCE, "/ngsi/farm");
        assertThat(translate("{\"subscriptionId\": \"a b\\n\", \"data\": [{\"id\": \"a\"}]}")
                        .records()
                        .get(0)
                        .headers())
                .containsEntry(HeaderNames.CE_SOURCE, "/ngsi/farm");
    }

    @Test
    void dropsAndCountsExcludedTypesOnly() {
        Translation translation = translate("""
                {"data": [{"id": "a", "type": "Analytics:Collision"}, {"id": "b", "type": "Domain"},
                 {"id": "c", "type": "DomainX"}]}""");

        assertThat(translation.records()).extracting(KafkaRecord::key).containsExactly("c");
        assertThat(translation.refusal()).isEmpty();
        assertThat(ledger.excluded.sum()).isEqualTo(2);
    }

    @Test
    void setsABadEntityAsideAndPassesTheGoodOnesOn() {
        Translation translation =
                translate("{\"data\": [{\"id\": \"a\"}, {\"type\": \"T\", \"x\": 7}, {\"id\": \"c\"}]}");

        assertThat(translation.refusal()).isEmpty();
        assertThat(translation.records())
                .extracting(KafkaRecord::topic, KafkaRecord::key)
                .containsExactly(
                        org.assertj.core.groups.Tuple.tuple("raw", "a"),
                        org.assertj.core.groups.Tuple.tuple("raw", "c"),
                        org.assertj.core.groups.Tuple.tuple("raw.dead", null));
        KafkaRecord dead = translation.records().get(2);
        assertThat(text(dead)).isEqualTo("{\"type\":\"T\",\"x\":7}");
        assertThat(dead.headers())
                .containsEntry(DeadLetter.REASON, "not-an-entity")
                .containsEntry(DeadLetter.STAGE, "ngsi-source")
                .containsEntry(DeadLetter.SOURCE, "10.0.0.7 /notify");
    }

    @Test
    void refusesANotificationOfWhichNothingCanBeRead() {
        Translation translation = translate("{\"data\": [{\"x\": 7}]}");

        assertThat(translation.refusal()).map(Translation.Refusal::reason).contains(Reason.NOT_AN_ENTITY);
        assertThat(translation.records()).hasSize(1);
    }

    @Test
    void keepsTheOriginalBytesOfABodyThatIsNoJson() {
        byte[] body = {'{', (byte) 0xff, 0, 'x'};

        Translation translation = translator.translate(received(body, true));

        assertThat(translation.refusal()).map(Translation.Refusal::reason).contains(Reason.NOT_JSON);
        assertThat(translation.records().get(0).value()).isEqualTo(body);
        assertThat(translation.records().get(0).topic()).isEqualTo("raw.dead");
    }

    @Test
    void keepsTheBeginningOfABodyThatWasTooLargeAndSaysSo() {
        Translation translation = translator.translate(received(bytes("{\"id\": \"beginning"), false));

        assertThat(translation.refusal()).map(Translation.Refusal::reason).contains(Reason.TOO_LARGE);
        assertThat(translation.records().get(0).headers().get(DeadLetter.MESSAGE))
                .contains("17 bytes", "truncated");
    }

    @Test
    void setsAnEntityAsideWhoseRecordWouldBeTooLarge() {
        String large = "x".repeat(RECORD_LIMIT);

        Translation translation =
                translate("{\"data\": [{\"id\": \"a\"}, {\"id\": \"b\", \"image\": \"" + large + "\"}]}");

        assertThat(translation.records()).extracting(KafkaRecord::topic).containsExactly("raw", "raw.dead");
        KafkaRecord dead = translation.records().get(1);
        assertThat(dead.bytes()).isLessThanOrEqualTo(RECORD_LIMIT);
        assertThat(dead.headers())
                .containsEntry(DeadLetter.REASON, "too-large")
                .hasEntrySatisfying(
                        DeadLetter.MESSAGE, message -> assertThat(message).contains("truncated"));
    }

    @Test
    void setsANotificationAsideWhoseRecordsTheJournalNeverHasRoomFor() {
        String entity = "{\"id\": \"a\", \"text\": \"" + "x".repeat(RECORD_LIMIT / 2) + "\"}";
        String body = "{\"data\": [" + String.join(",", Collections.nCopies(10, entity)) + "]}";

        Translation translation = translate(body);

        assertThat(translation.refusal()).map(Translation.Refusal::reason).contains(Reason.TOO_LARGE);
        assertThat(translation.records())
                .singleElement()
                .satisfies(dead -> assertThat(dead.headers())
                        .hasEntrySatisfying(
                                DeadLetter.MESSAGE,
                                message -> assertThat(message).contains("journal.max.bytes")));
        assertThat(ledger.received.sum()).isEqualTo(1);
        assertThat(ledger.dead.sum()).isEqualTo(1);
        assertThat(ledger.accepted.sum()).isZero();
    }

    @Test
    void keepsANotificationInOnePieceOfWhichTooManyEntitiesCannotBeRead() {
        String body = "{\"data\": [{\"id\": \"a\"}" + ",0".repeat(1001) + "]}";

        Translation translation = translate(body);

        assertThat(translation.refusal()).map(Translation.Refusal::reason).contains(Reason.NOT_AN_ENTITY);
        assertThat(translation.records())
                .singleElement()
                .satisfies(dead -> assertThat(text(dead)).isEqualTo(body));
        assertThat(ledger.dead.sum()).isEqualTo(1);
    }

    @Test
    void passesHalfASurrogatePairOnAsAnEscape() {
        String text = "x".repeat(20_000) + "\\ud800" + "y".repeat(20_000) + "\\udc00";

        Translation translation = translate("{\"id\": \"a\", \"name\\udfff\": \"" + text + "\"}");

        assertThat(text(translation.records().get(0)).toLowerCase(java.util.Locale.ROOT))
                .contains(text, "\"name\\udfff\"");
    }

    @Test
    void usesTheReceiptForAClockThatIsTooFarAheadAndCountsIt() {
        Translation ahead =
                translate("{\"id\": \"a\", \"Time\": " + NOW.plusSeconds(301).toEpochMilli() + "}");
        Translation tolerated =
                translate("{\"id\": \"b\", \"Time\": " + NOW.plusSeconds(299).toEpochMilli() + "}");

        assertThat(ahead.records().get(0).time()).isEqualTo(NOW);
        assertThat(tolerated.records().get(0).time()).isEqualTo(NOW.plusSeconds(299));
        assertThat(ledger.clockAhead.sum()).isEqualTo(1);
    }

    @Test
    void namesADeviceWhoseTimeCannotBeRead() {
        List<String> warnings = new ArrayList<>();
        AbstractAppender recorder = new AbstractAppender("recorder", null, null, true, Property.EMPTY_ARRAY) {
            @Override
            public void append(LogEvent event) {
                warnings.add(event.getMessage().getFormattedMessage());
            }
        };
        Logger logger = (Logger) LogManager.getLogger(NotificationTranslator.class);
        recorder.start();
        logger.addAppender(recorder);
        Configurator.setLevel(logger, Level.WARN);
        try {
            translate("{\"id\": \"a\", \"Time\": \"noon\"}");
        } finally {
            logger.removeAppender(recorder);
        }

        assertThat(warnings).singleElement().asString().contains("agri|/plot1|a ", "cannot be read");
    }

    private Translation translate(String body) {
        return translator.translate(received(bytes(body), true));
    }

    private static ReceivedNotification received(byte[] body, boolean complete) {
        FiwareScope scope = new FiwareScope("agri", "/plot1");
        return new ReceivedNotification(body, complete, null, scope, NOW, "10.0.0.7 /notify");
    }

    private static byte[] bytes(String text) {
        return text.getBytes(UTF_8);
    }

    private static String text(KafkaRecord record) {
        return new String(record.value(), UTF_8);
    }
}
