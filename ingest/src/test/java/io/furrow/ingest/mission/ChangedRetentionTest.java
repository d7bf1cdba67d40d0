package io.furrow.ingest.mission;

import java.time.Clock;
import java.time.Duration;

import com.mongodb.client.MongoClient;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.Retention;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** Another retention for a mission whose index on event time is there. */
class ChangedRetentionTest {
    private FaultyMongo mongo;
    private MongoClient client;

    @BeforeEach
    void keepAMissionForADay() {
        mongo = new FaultyMongo();
        client = new MongoAccess(mongo.uri(), MongoAccess.Waits.of(Duration.ZERO)).open();
        keep(Duration.ofDays(1));
    }

    @AfterEach
    void stop() {
        client.close();
        mongo.stop();
    }

    @Test
    void altersTheIndex() {
        keep(Duration.ofDays(2));

        assertThat(mongo.expireAfter("mission_m")).isEqualTo(172_800L);
        assertThat(mongo.indexCommands()).containsExactly("collMod");
    }

    @Test
    void keepsForEverByTheLongestTimeThereIs() {
        keep(null);

        assertThat(mongo.expireAfter("mission_m")).isEqualTo((long) Integer.MAX_VALUE);
        assertThat(mongo.indexCommands()).containsExactly("collMod");
    }

    @Test
    void buildsTheIndexAnewWhereTheServerDoesNotAlterIt() {
        mongo.failAlterations(72);

        keep(Duration.ofDays(2));

        assertThat(mongo.expireAfter("mission_m")).isEqualTo(172_800L);
        assertThat(mongo.indexCommands()).containsExactly("collMod", "dropIndexes");
    }

    @Test
    void leavesTheIndexWhereItsUserMayNotAlterIt() {
        Object before = mongo.expireAfter("mission_m");
        mongo.failAlterations(13);

        keep(Duration.ofDays(2));

        assertThat(mongo.expireAfter("mission_m")).isEqualTo(before).isNotEqualTo(172_800L);
        assertThat(mongo.indexCommands()).containsExactly("collMod");
    }

    @Test
    void leavesTheIndexWhereAnotherTakesItsTimeWithIt() {
        mongo.failAlterations(12_587); // it is being built

        assertThatThrownBy(() -> keep(Duration.ofDays(2))).hasMessageContaining("12587");
        assertThat(mongo.indexCommands()).containsExactly("collMod");
    }

    private void keep(Duration time) {
        new MissionCollections(client, new Retention(time, Retention.FOR_EVER.byCollection()), Clock.systemUTC(), true)
                .prepared("mission_m");
    }
}
