package io.furrow.stores;

import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.io.IOException;

import org.apache.flink.core.fs.Path;

import io.furrow.embedded.EmbeddedMongo;
import io.furrow.mission.archive.MissionArchive;
import io.furrow.mission.archive.MissionFiles;
import io.furrow.mission.archive.StoredMissions;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** A mission of two days, archived and brought back. */
final class ArchivedMission {
    private static final int EVENTS = 2_000;
    private static final long FIRST_NOON = 1_700_049_600_000L;
    private static final long MINUTE = 60_000;

    private ArchivedMission() {}

    static void comesBackFrom(String root) throws Exception {
        try (EmbeddedMongo mongo = EmbeddedMongo.inMemory();
                StoredMissions missions = StoredMissions.open(mongo.uri())) {
            missions.importFrom("weeding", new ByteArrayInputStream(lines()), "lines", told -> {});
            MissionArchive archive = new MissionArchive(missions, new Path(root));

            assertThat(archive.archive("weeding")).isEqualTo(new MissionArchive.Outcome(2, EVENTS, 0));
            assertThat(archive.archive("weeding")).isEqualTo(new MissionArchive.Outcome(0, 0, EVENTS));
            MissionFiles.importFrom(missions, "copy", archive.folder("weeding"), told -> {});
            assertThat(exported(missions, "copy")).isEqualTo(lines());

            Path file = new Path(root, "weeding.ndjson.gz");
            MissionFiles.write(file, out -> missions.export("weeding", out, told -> {}));
            MissionFiles.write(file, out -> missions.export("weeding", out, told -> {})); // in the place of the first
            MissionFiles.importFrom(missions, "other", file, told -> {});
            assertThat(exported(missions, "other")).isEqualTo(lines());
        }
    }

    private static byte[] lines() {
        StringBuilder lines = new StringBuilder();
        for (int i = 0; i < EVENTS; i++) {
            lines.append(
                    "{\"id\":\"e%d\",\"time\":%d,\"headers\":{},\"entity\":{\"id\":\"t\",\"n\":{\"value\":%d.50}}}\n"
                            .formatted(i, FIRST_NOON + i * MINUTE, i));
        }
        return lines.toString().getBytes(UTF_8);
    }

    private static byte[] exported(StoredMissions missions, String mission) throws IOException {
        ByteArrayOutputStream out = new ByteArrayOutputStream();
        missions.export(mission, out, told -> {});
        return out.toByteArray();
    }
}
