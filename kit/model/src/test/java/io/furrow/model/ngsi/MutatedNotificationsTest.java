package io.furrow.model.ngsi;

import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Random;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;

import io.furrow.model.event.EntityEvent;
import io.furrow.model.event.EventTimeRule;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.Origin;
import io.furrow.model.position.PositionReading;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.fail;

/** Checks that randomly mutated notifications are unreadable or accepted by every accessor and reader. */
@Timeout(60)
class MutatedNotificationsTest {
    private static final long SEED = 20261121;
    private static final int ROUNDS = 6000;
    private static final Instant RECEIVED = Instant.parse("2026-11-21T01:11:05Z");
    private static final Duration SKEW = Duration.ofMinutes(5);
    private static final String[] HEADERS = {
        null, "normalized", "keyValues", "simplifiedNormalized", "simplifiedKeyValues", "values"
    };
    private final Random random = new Random(SEED);
    private final Mutations mutations = new Mutations(random);

    @Test
    void areUnreadableOrAcceptedByAllReaders() {
        List<RecordedNotification> recorded = RecordedNotification.all();
        int read = 0;
        int unreadable = 0;
        for (int round = 0; round < ROUNDS; round++) {
            byte[] body =
                    mutations.of(recorded.get(random.nextInt(recorded.size())).body());
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
                fail("seed %d round %d header %s body %s", SEED, round, header, new String(body, UTF_8), e);
            }
        }
        assertThat(read).as("readable entities").isGreaterThan(ROUNDS / 5);
        assertThat(unreadable).as("unreadable bodies").isGreaterThan(ROUNDS / 5);
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
        EntityEvent event =
                EntityEvent.of(entity, FiwareScope.DEFAULT, RECEIVED, EventTimeRule.within(SKEW), Origin.NOTIFICATION);
        assertThat(event.time().time()).isBetween(Instant.EPOCH, RECEIVED.plus(SKEW));
        assertThat(event.headers("/test")).doesNotContainValue(null);
        assertThat(event.id()).matches("[0-9a-f]{32}");
    }
}
