package io.furrow.control;

import java.io.File;
import java.io.IOException;
import java.nio.file.Path;
import java.util.Properties;

import io.furrow.process.TestProcess;

/** Runs a control plane in a separate process that can be killed. */
public final class ControlPlaneProcess {
    private ControlPlaneProcess() {}

    /** Runs until it is killed. */
    public static void main(String[] args) throws Exception {
        var plane = ControlPlane.start(settings(args[0], args[1]).withStandbyReplicas(Integer.parseInt(args[2])));
        Thread.currentThread().join();
        plane.close();
    }

    public static ControlSettings settings(String bootstrapServers, String directory) {
        Properties client = new Properties();
        client.setProperty("bootstrap.servers", bootstrapServers);
        client.setProperty("state.dir", directory);
        return ControlSettings.of(client);
    }

    static Process start(String bootstrapServers, Path directory, int standbyReplicas) throws IOException {
        return TestProcess.java("-Xmx256m", ControlPlaneProcess.class, bootstrapServers, directory, standbyReplicas)
                .redirectErrorStream(true)
                .redirectOutput(new File(directory + ".log"))
                .start();
    }
}
