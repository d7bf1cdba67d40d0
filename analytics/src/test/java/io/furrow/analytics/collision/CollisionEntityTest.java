package io.furrow.analytics.collision;

import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.collision.motion.Approach;
import io.furrow.analytics.position.PositionFix;
import io.furrow.model.ngsi.Entity;

import static org.assertj.core.api.Assertions.assertThat;

class CollisionEntityTest {
    private static final PositionFix FIRST = Fixes.of("farm|/|r1", "r1", "hoe", 40.5, -3.25, 1000);
    private static final PositionFix SECOND = Fixes.of("farm|/|r2", "r2", "", 40.5, -3.5, 2000);

    private final Encounter encounter = new Encounter(Phase.ONGOING, FIRST, SECOND, 4.5, 1.5, 1500, 2000);

    @Test
    void carriesWhatReadersOfCollisionsKnowAndTheEncounter() {
        String pair = encounter.pairId();
        assertThat(pair).matches("[0-9a-f]{32}");
        assertThat(new String(CollisionEntity.of(encounter).toBytes(), java.nio.charset.StandardCharsets.UTF_8))
                .isEqualTo("""
                        {"id":"Analytics:Collision:PAIR","type":"Analytics:Collision",\
                        "distance":{"type":"Float","value":4.5,"metadata":{}},\
                        "time":{"type":"Integer","value":2000,"metadata":{}},\
                        "Device1_ID":{"type":"String","value":"r1","metadata":{}},\
                        "Device1_latitude":{"type":"Float","value":40.5,"metadata":{}},\
                        "Device1_longitude":{"type":"Float","value":-3.25,"metadata":{}},\
                        "Device1_timestamp":{"type":"Integer","value":1000,"metadata":{}},\
                        "Device1_Mission":{"type":"String","value":"hoe","metadata":{}},\
                        "Device1_type":{"type":"String","value":"ROBOT","metadata":{}},\
                        "Device2_ID":{"type":"String","value":"r2","metadata":{}},\
                        "Device2_latitude":{"type":"Float","value":40.5,"metadata":{}},\
                        "Device2_longitude":{"type":"Float","value":-3.5,"metadata":{}},\
                        "Device2_timestamp":{"type":"Integer","value":2000,"metadata":{}},\
                        "Device2_Mission":{"type":"String","value":"","metadata":{}},\
                        "Device2_type":{"type":"String","value":"ROBOT","metadata":{}},\
                        "encounter":{"type":"String","value":"PAIR@1500","metadata":{}},\
                        "phase":{"type":"String","value":"ongoing","metadata":{}},\
                        "minDistance":{"type":"Float","value":1.5,"metadata":{}},\
                        "startTime":{"type":"Integer","value":1500,"metadata":{}}}""".replace("PAIR", pair));
    }

    @Test
    void isOnePerPairWhateverTheEncounter() {
        Entity entity = CollisionEntity.of(encounter).build();
        Entity later = CollisionEntity.of(new Encounter(Phase.STARTED, FIRST, SECOND, 1, 1, 9000, 9000))
                .build();
        PositionFix elsewhere = Fixes.of("other|/|r2", "r2", "", 40.5, -3.5, 2000);
        Entity other = CollisionEntity.of(new Encounter(Phase.STARTED, FIRST, elsewhere, 1, 1, 9000, 9000))
                .build();
        assertThat(later.id()).isEqualTo(entity.id());
        assertThat(later.text("encounter")).isNotEqualTo(entity.text("encounter"));
        assertThat(other.id()).isNotEqualTo(entity.id());
    }

    /** The record has the scope of the first device only. */
    @Test
    void namesTheScopeOfTheSecondDeviceIfItDiffers() {
        PositionFix elsewhere = Fixes.of("|/north|ROBOT|r2", "r2", "", 40.5, -3.5, 2000);
        Entity started = CollisionEntity.of(new Encounter(Phase.STARTED, FIRST, elsewhere, 1, 1, 9000, 9000))
                .build();
        Entity predicted = CollisionEntity.of(new Approach(Phase.PREDICTED, FIRST, elsewhere, 4, 1, 3, 1000, 2000))
                .build();
        for (Entity entity : List.of(started, predicted)) {
            assertThat(entity.value("Device2_service").orElseThrow().textValue())
                    .isEmpty();
            assertThat(entity.text("Device2_servicePath")).contains("/north");
            assertThat(entity.value("Device1_servicePath")).isEmpty();
        }
    }

    @Test
    void hasBothIdsAsTheKeyOfItsRecord() {
        assertThat(CollisionEntity.key(encounter)).isEqualTo("r1-r2");
    }
}
