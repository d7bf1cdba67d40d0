package io.furrow.model.event;

import java.time.Duration;
import java.time.Instant;
import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Notification;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** Which copies of a change share an id: one test for each row of the table in {@code docs/topics.md}. */
class EventCopiesTest {
    private static final EventTimeRule RULE = EventTimeRule.within(Duration.ofMinutes(5));
    private static final FiwareScope SCOPE = FiwareScope.of("farm", "/");
    private static final Instant FIRST = Instant.parse("2026-03-01T08:00:05Z");
    private static final Instant LATER = Instant.parse("2026-03-01T09:00:00Z");

    private static final String MEASURED = "'TimeInstant':'2026-03-01T08:00:00.000Z'";
    private static final String MODIFIED = "'dateModified':'2026-03-01T08:00:01.250Z'";
    private static final String MODIFIED_NEXT = "'dateModified':'2026-03-01T08:00:02.250Z'";

    @Test
    void areOneWhereANotificationIsDeliveredTwice() throws Exception {
        String valve = valve("on", MEASURED, MODIFIED);
        assertThat(id(valve, Origin.NOTIFICATION, FIRST)).isEqualTo(id(valve, Origin.NOTIFICATION, LATER));
        String undated = valve("on", MEASURED);
        assertThat(id(undated, Origin.NOTIFICATION, FIRST)).isEqualTo(id(undated, Origin.NOTIFICATION, LATER));
    }

    @Test
    void areOneOverHttpAndNativeKafka() throws Exception {
        for (String valve : List.of(valve("on", MEASURED, MODIFIED), valve("on", MEASURED), valve("on", MODIFIED))) {
            assertThat(id(valve, Origin.NOTIFICATION, FIRST)).isEqualTo(id(valve, Origin.KAFKA, LATER));
        }
    }

    @Test
    void areOneWhereTheRepairReadsWhatWasToldWithDateModified() throws Exception {
        String valve = valve("on", MEASURED, MODIFIED);
        assertThat(id(valve, Origin.REPAIR, LATER)).isEqualTo(id(valve, Origin.NOTIFICATION, FIRST));
    }

    @Test
    void areOneInWhateverFormTheyCome() throws Exception {
        String normalized = "{'id':'v','type':'Valve','state':{'type':'Text','value':'on','metadata':{}},"
                + "'dateModified':{'type':'DateTime','value':'2026-03-01T08:00:01.250Z','metadata':{}}}";
        assertThat(id(normalized, Origin.NOTIFICATION, FIRST))
                .isEqualTo(id(valve("on", MODIFIED), Origin.NOTIFICATION, FIRST));
    }

    @Test
    void areSeveralWhereOnlyOneSubscriptionAsksForDateModified() throws Exception {
        assertThat(id(valve("on", MEASURED, MODIFIED), Origin.NOTIFICATION, FIRST))
                .isNotEqualTo(id(valve("on", MEASURED), Origin.NOTIFICATION, FIRST));
    }

    @Test
    void areSeveralWhereSubscriptionsTellOtherAttributes() throws Exception {
        assertThat(id(valve("on", MODIFIED), Origin.NOTIFICATION, FIRST))
                .isNotEqualTo(id(valve("on", MODIFIED, "'pressure':3"), Origin.NOTIFICATION, FIRST));
    }

    @Test
    void areSeveralWithoutAnyTimeOfTheirOwn() throws Exception {
        assertThat(id(valve("on"), Origin.NOTIFICATION, FIRST)).isNotEqualTo(id(valve("on"), Origin.KAFKA, LATER));
    }

    /** A change back to an earlier value is another event, though the device measured nothing between. */
    @Test
    void areNoCopiesWhereSomethingIsTurnedOnOffAndOnAgain() throws Exception {
        for (Origin origin : List.of(Origin.NOTIFICATION, Origin.KAFKA, Origin.REPAIR)) {
            assertThat(List.of(
                            id(valve("on", MEASURED, MODIFIED), origin, FIRST),
                            id(valve("off", MEASURED, MODIFIED_NEXT), origin, FIRST),
                            id(valve("on", MEASURED, MODIFIED_NEXT), origin, FIRST)))
                    .doesNotHaveDuplicates();
        }
    }

    @Test
    void areTakenForCopiesWhereNothingTellsThemApart() throws Exception {
        assertThat(id(valve("on", MEASURED), Origin.NOTIFICATION, FIRST))
                .isEqualTo(id(valve("on", MEASURED), Origin.NOTIFICATION, LATER));
    }

    @Test
    void areNoCopiesWhereADeviceMeasuresTheSameTwice() throws Exception {
        assertThat(id(valve("on", MODIFIED), Origin.NOTIFICATION, FIRST))
                .isNotEqualTo(id(valve("on", MODIFIED_NEXT), Origin.NOTIFICATION, FIRST));
    }

    private static String valve(String state, String... members) {
        return "{'id':'v','type':'Valve','state':'%s'%s}"
                .formatted(state, members.length == 0 ? "" : "," + String.join(",", members));
    }

    private static String id(String json, Origin origin, Instant received) throws UnreadableException {
        byte[] body = ("{'subscriptionId':'s','data':[" + json + "]}")
                .replace('\'', '"')
                .getBytes(UTF_8);
        Entity entity = Notification.read(body, null).entities().get(0);
        return EntityEvent.of(entity, SCOPE, received, RULE, origin).id();
    }
}
