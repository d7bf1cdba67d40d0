package io.furrow.flink.job;

import java.util.LinkedHashMap;
import java.util.Map;

import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.GlobalConfiguration;
import org.apache.flink.core.fs.FileSystem;
import org.apache.flink.core.plugin.PluginUtils;
import picocli.CommandLine.Option;
import picocli.CommandLine.ScopeType;

/**
 * Configures Flink's file systems in the same way for every command: like Flink itself, by {@code FLINK_CONF_DIR} and
 * {@code FLINK_PLUGINS_DIR} (S3) and Hadoop on the class path (HDFS); and by option.
 */
public final class FileSystemOptions {
    @Option(
            names = "--file-system",
            paramLabel = "KEY=VALUE",
            scope = ScopeType.INHERIT,
            description =
                    "A file system setting of Flink, for instance s3.endpoint=http://127.0.0.1:9000; takes precedence "
                            + "over the file in FLINK_CONF_DIR. May be repeated. S3 needs FLINK_PLUGINS_DIR, HDFS "
                            + "HADOOP_CLASSPATH, as for Flink itself.")
    private Map<String, String> settings = new LinkedHashMap<>();

    /** Must be called before the first path is used. */
    public void initialize() {
        Configuration flink =
                System.getenv("FLINK_CONF_DIR") == null ? new Configuration() : GlobalConfiguration.loadConfiguration();
        flink.addAll(Configuration.fromMap(settings));
        FileSystem.initialize(flink, PluginUtils.createPluginManagerFromRootFolder(flink));
    }
}
