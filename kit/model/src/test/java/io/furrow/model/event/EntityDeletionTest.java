package io.furrow.model.event;

import java.time.Duration;
import java.time.Instant;

import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Notification;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class EntityDeletionTest {
    private static final Instant RECEIVED = Instant.parse("2026-11-21T12:00:00.123456Z");
    private static final Duration SKEW = Duration.ofMinutes(5);
    private static final FiwareScope SCOPE = FiwareScope.of("Agri", "/p");

    @Test
    void hasTheTimeOfItsReceiptAndNotOfTheLastValues() throws Exception {
        Entity deleted = entity("""
                {"id": "a", "type": "T", "TimeInstant": {"type": "DateTime", "value": "2026-01-01T00:00:00Z"},
                 "dateModified": {"type": "DateTime", "value": "2026-01-01T00:00:00Z"},
                 "alterationType": {"type": "Text", "value": "entityDelete"}}""");

        assertThat(deleted.isDeleted()).isTrue();
        assertThat(deletion(deleted).time()).isEqualTo("2026-11-21T12:00:00.123Z");
    }

    @Test
    void hasTheTimeThatTheContextBrokerReports() throws Exception {
        Entity deleted = entity(
                "{\"type\": \"Notification\", \"data\": [{\"id\": \"a\", \"type\": \"T\", \"deletedAt\": \"2026-11-21T11:59:00Z\"}]}");

        assertThat(deleted.isDeleted()).isTrue();
        assertThat(deletion(deleted).time()).isEqualTo("2026-11-21T11:59:00Z");
    }

    @Test
    void hasTheTimeOfItsReceiptIfTheBrokersClockIsAhead() throws Exception {
        Entity deleted = entity(
                "{\"type\": \"Notification\", \"data\": [{\"id\": \"a\", \"type\": \"T\", \"deletedAt\": \"2027-11-21T11:59:00Z\"}]}");

        assertThat(deletion(deleted).time()).isEqualTo("2026-11-21T12:00:00.123Z");
    }

    @Test
    void isDistinctFromAChange() throws Exception {
        assertThat(entity("{\"id\": \"a\", \"alterationType\": {\"value\": \"entityChange\"}}")
                        .isDeleted())
                .isFalse();
        assertThat(entity("{\"id\": \"a\"}").isDeleted()).isFalse();
    }

    @Test
    void isNamedInTheHeaders() throws Exception {
        EntityDeletion deletion = deletion(entity("{\"id\": \"a\", \"alterationType\": \"entityDelete\"}"));

        assertThat(deletion.headers("/ngsi/s"))
                .containsEntry("ce_type", "ngsi.entity.deleted")
                .containsEntry("ce_source", "/ngsi/s")
                .containsEntry("ce_time", "2026-11-21T12:00:00.123Z")
                .containsEntry("fiware-service", "agri")
                .containsEntry("fiware-servicepath", "/p")
                .containsEntry("origin", "notification")
                .containsEntry("ts-source", Long.toString(RECEIVED.toEpochMilli()));
    }

    @Test
    void hasAnIdDifferentFromThatOfAnyChange() throws Exception {
        Entity deleted = entity("{\"id\": \"a\", \"alterationType\": \"entityDelete\"}");

        assertThat(deletion(deleted).id())
                .isEqualTo(deletion(deleted).id())
                .isNotEqualTo(EntityEvent.of(
                                entity("{\"id\": \"a\"}"),
                                SCOPE,
                                RECEIVED,
                                EventTimeRule.within(SKEW),
                                Origin.NOTIFICATION)
                        .id());
    }

    private static EntityDeletion deletion(Entity deleted) {
        return EntityDeletion.of(deleted, SCOPE, RECEIVED, SKEW, Origin.NOTIFICATION);
    }

    private static Entity entity(String body) throws Exception {
        return Notification.read(body.getBytes(UTF_8), null).entities().get(0);
    }
}
