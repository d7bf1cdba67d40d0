package io.furrow.connect;

import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.util.Properties;

/** The version of the plugin, for instance {@code 0.1.0}. */
public final class PluginVersion {
    private static final String RESOURCE = "/furrow-ngsi-connector.properties";

    private PluginVersion() {}

    public static String get() {
        try (InputStream in = PluginVersion.class.getResourceAsStream(RESOURCE)) {
            Properties properties = new Properties();
            properties.load(in);
            return properties.getProperty("version");
        } catch (IOException e) {
            throw new UncheckedIOException("cannot read " + RESOURCE, e);
        }
    }
}
