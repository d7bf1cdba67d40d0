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

/** Tests which copies of a change share an id, with one test for each row of the table in {@code docs/topics.md}. */
class EventCopiesTest {
    private static final EventTimeRule RULE = EventTimeRule.within(Duration.ofMinutes(5));
    private static final FiwareScope SCOPE = FiwareScope.of("farm", "/");
    private static final Instant FIRST = Instant.parse("2026-03-01T08:00:05Z");
    private static final Instant LATER = Instant.parse("2026-03-01T09:00:00Z");

    private static final String MEASURED = "'TimeInstant':'2026-03-01T08:00:00.000Z'";
    private static final String MODIFIED = "'dateModified':'2026-03-01T08:00:01.250Z'";
    private static final String MODIFIED_NEXT = "'dateModified':'2026-03-01T08:00:02.250Z'";

    @Test
    void shareAnIdIfANotificationIsDeliveredTwice() throws Exception {
        String valve = valve("on", MEASURED, MODIFIED);
        assertThat(id(valve, Origin.NOTIFICATION, FIRST)).isEqualTo(id(valve, Origin.NOTIFICATION, LATER));
        String undated = valve("on", MEASURED);
        assertThat(id(undated, Origin.NOTIFICATION, FIRST)).isEqualTo(id(undated, Origin.NOTIFICATION, LATER));
    }

    @Test
    void shareAnIdOverHttpAndNativeKafka() throws Exception {
        for (String valve : List.of(valve("on", MEASURED, MODIFIED), valve("on", MEASURED), valve("on", MODIFIED))) {
            assertThat(id(valve, Origin.NOTIFICATION, FIRST)).isEqualTo(id(valve, Origin.KAFKA, LATER));
        }
    }

    @Test
    void shareAnIdIfARepairReadsANotificationWithDateModified() throws Exception {
        String valve = valve("on", MEASURED, MODIFIED);
        assertThat(id(valve, Origin.REPAIR, LATER)).isEqualTo(id(valve, Origin.NOTIFICATION, FIRST));
    }

    @Test
    void shareAnIdInAllRepresentations() throws Exception {
        String normalized = "{'id':'v','type':'Valve','state':{'type':'Text','value':'on','metadata':{}},"
                + "'dateModified':{'type':'DateTime','value':'2026-03-01T08:00:01.250Z','metadata':{}}}";
        assertThat(id(normalized, Origin.NOTIFICATION, FIRST))
                .isEqualTo(id(valve("on", MODIFIED), Origin.NOTIFICATION, FIRST));
    }

    @Test
    void differIfOnlyOneSubscriptionRequestsDateModified() throws Exception {
        assertThat(id(valve("on", MEASURED, MODIFIED), Origin.NOTIFICATION, FIRST))
                .isNotEqualTo(id(valve("on", MEASURED), Origin.NOTIFICATION, FIRST));
    }

    @Test
    void differIfSubscriptionsReportOtherAttributes() throws Exception {
        assertThat(id(valve("on", MODIFIED), Origin.NOTIFICATION, FIRST))
                .isNotEqualTo(id(valve("on", MODIFIED, "'pressure':3"), Origin.NOTIFICATION, FIRST));
    }

    @Test
    void differWithoutAnyTimeOfTheirOwn() throws Exception {
        assertThat(id(valve("on"), Origin.NOTIFICATION, FIRST)).isNotEqualTo(id(valve("on"), Origin.KAFKA, LATER));
    }

    /** A change back to an earlier value is another event, even without a measure of the device between. */
    @Test
    void differIfSomethingIsTurnedOnOffAndOnAgain() throws Exception {
        for (Origin origin : List.of(Origin.NOTIFICATION, Origin.KAFKA, Origin.REPAIR)) {
            assertThat(List.of(
                            id(valve("on", MEASURED, MODIFIED), origin, FIRST),
                            id(valve("off", MEASURED, MODIFIED_NEXT), origin, FIRST),
                            id(valve("on", MEASURED, MODIFIED_NEXT), origin, FIRST)))
                    .doesNotHaveDuplicates();
        }
    }

    @Test
    void shareAnIdIfNothingDistinguishesThem() throws Exception {
        assertThat(id(valve("on", MEASURED), Origin.NOTIFICATION, FIRST))
                .isEqualTo(id(valve("on", MEASURED), Origin.NOTIFICATION, LATER));
    }

    @Test
    void differIfADeviceMeasuresTheSameTwice() throws Exception {
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
