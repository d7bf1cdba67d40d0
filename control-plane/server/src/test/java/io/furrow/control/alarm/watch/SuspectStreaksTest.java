package io.furrow.control.alarm.watch;

import java.util.List;
import java.util.Map;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class SuspectStreaksTest {
    @Test
    void distinguishesSensorsWhoseTypesAndIdsContainBars() {
        FieldWindow.Suspect odd = new FieldWindow.Suspect("c", "a|b");
        SuspectStreaks runs = new SuspectStreaks("f", 0, Map.of())
                .after(new FieldWindow("f", 20.0, List.of(odd), 0, 60_000, null, true));
        assertThat(runs.of(odd)).isEqualTo(1);
        assertThat(runs.of(new FieldWindow.Suspect("b|c", "a"))).isZero();
    }
}
