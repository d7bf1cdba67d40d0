package io.furrow.suite.page;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

/** Events reach the map and cards. {@code ./furrow soak page --only delay} measures how long it takes. */
@PageTest
@Tag("full")
class DelayIT {
    private static final int EVENTS = 40;

    @Test
    void showsEachEventOnTheMapAndOnItsCard(PageSuite suite) throws Exception {
        Marks.Delays delays = Marks.measure(suite, EVENTS, 700);

        assertThat(delays.canvas()).hasSizeGreaterThan(EVENTS * 9 / 10);
        assertThat(delays.card()).hasSizeGreaterThan(EVENTS * 9 / 10);
    }
}
