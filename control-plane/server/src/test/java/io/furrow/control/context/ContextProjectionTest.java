package io.furrow.control.context;

import java.util.List;
import java.util.function.Function;

import org.junit.jupiter.api.Test;

import io.furrow.control.alarm.watch.FieldWindow;
import io.furrow.control.domain.Domain;
import io.furrow.control.manager.MapTable;
import io.furrow.control.mission.Mission;
import io.furrow.control.mission.MissionStatus;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.EntityBuilder;

import static org.assertj.core.api.Assertions.assertThat;

class ContextProjectionTest {
    private static final long NOW = 1_700_000_000_000L;
    private static final long AHEAD = NOW + 7_200_000;

    private final MapTable<FieldState> fields = MapTable.of(FieldState.class);
    private final ContextProjection projection = new ContextProjection(
            new ContextTables(
                    MapTable.of(Domain.class),
                    MapTable.of(Mission.class),
                    MapTable.of(MissionStatus.class),
                    MapTable.of(MissionCounts.class),
                    fields,
                    MapTable.of(String.class),
                    new MapTable<>(Function.identity(), Function.identity())),
            new ContextProjection.PublicationListener() {
                @Override
                public void changed(EntityBuilder entity) {}

                @Override
                public void deleted(String type, String entityId) {}
            });

    @Test
    void acceptsAveragesAgainWhenTheClockIsSetBack() {
        projection.window(window(AHEAD, 1.0), FiwareScope.DEFAULT, AHEAD);
        projection.passTime(AHEAD);
        projection.passTime(NOW);
        projection.window(window(NOW, 2.0), FiwareScope.DEFAULT, NOW);
        assertThat(fields.all()).extracting(FieldState::average).containsExactly(2.0);
    }

    private static FieldWindow window(long end, double average) {
        return new FieldWindow("north", average, List.of(), end - 60_000, end, null, true);
    }
}
