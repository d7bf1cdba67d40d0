package io.furrow.stores;

import java.nio.file.Path;
import java.util.Map;

import org.apache.flink.runtime.testutils.MiniClusterResourceConfiguration;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.apache.hadoop.conf.Configuration;
import org.apache.hadoop.hdfs.MiniDFSCluster;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

/** A name node and a data node, written to through Flink's own HDFS client. */
@Tag("full")
class ImagesOnHdfsIT {
    @RegisterExtension
    static final MiniClusterExtension FLINK = new MiniClusterExtension(new MiniClusterResourceConfiguration.Builder()
            .setNumberTaskManagers(1)
            .setNumberSlotsPerTaskManager(2)
            .build());

    @TempDir
    static Path folder;

    private static MiniDFSCluster hdfs;

    @BeforeAll
    static void start() throws Exception {
        Configuration settings = new Configuration();
        settings.set(MiniDFSCluster.HDFS_MINIDFS_BASEDIR, folder.toString());
        hdfs = new MiniDFSCluster.Builder(settings).numDataNodes(1).build();
        hdfs.waitActive();
    }

    @AfterAll
    static void stop() {
        hdfs.shutdown();
    }

    @Test
    void bringsAMissionBackFromItsArchive() throws Exception {
        ArchivedMission.comesBackFrom(hdfs.getURI() + "/archive");
    }

    @Test
    void keepsEachImageOnceUnderTheAddressThatItsEventCarries() throws Exception {
        String root = hdfs.getURI() + "/images";

        Map<String, byte[]> stored = StoredByJob.run(root);

        assertThat(stored).hasSize(StoredByJob.IMAGES);
        assertThat(stored.keySet()).allMatch(url -> url.startsWith(root + "/north/weeding/urn~3Angsi-ld~3ACamera~3A"));
        assertThat(StoredByJob.files(root)).containsExactlyInAnyOrderEntriesOf(stored);

        Map<String, byte[]> again = StoredByJob.run(root); // as after a restart from an early checkpoint

        assertThat(again).containsExactlyInAnyOrderEntriesOf(stored);
        assertThat(StoredByJob.files(root)).containsExactlyInAnyOrderEntriesOf(stored);
    }
}
