package io.furrow.connect;

import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.zip.ZipEntry;
import java.util.zip.ZipFile;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** The zip is a component archive as Confluent's hub has them, and brings nothing that the worker has. */
class PluginZipIT {
    private final Path zip = zip();
    private final String folder = zip.getFileName().toString().replace(".zip", "");

    @Test
    void holdsOneFolderWithManifestJarsPagesExamplesAndALogo() throws Exception {
        List<String> names = names();

        assertThat(names).isNotEmpty().allSatisfy(name -> assertThat(name).startsWith(folder + "/"));
        assertThat(names)
                .contains(
                        folder + "/manifest.json",
                        folder + "/doc/README.md",
                        folder + "/doc/LICENSE",
                        folder + "/doc/licenses.md",
                        folder + "/doc/docs/configuration.md",
                        folder + "/etc/ngsi-source.json",
                        folder + "/etc/ngsi-sink.json",
                        folder + "/assets/furrow.png");
    }

    @Test
    void saysInItsManifestWhatItIs() throws Exception {
        JsonNode manifest = NgsiJson.read(read("manifest.json"));

        String owner = manifest.at("/owner/username").textValue();
        String version = manifest.path("version").textValue();
        assertThat(owner + "-" + manifest.path("name").textValue() + "-" + version)
                .isEqualTo(folder);
        assertThat(manifest.path("component_types")).hasToString("[\"source\",\"sink\"]");
        assertThat(names()).contains(folder + "/" + manifest.path("logo").textValue());
    }

    @Test
    void bringsNoKafkaNoConnectAndNoLogging() throws Exception {
        assertThat(jars())
                .anyMatch(jar -> jar.startsWith("furrow-http-access-"))
                .noneMatch(
                        jar -> jar.matches("(kafka|connect)-.*|slf4j.*|.*log4j.*|logback.*|jcl-.*|commons-logging.*"));
    }

    @Test
    void namesTheLicenceOfEveryJar() throws Exception {
        String licenses = new String(read("doc/licenses.md"), UTF_8);

        assertThat(jars())
                .allSatisfy(
                        jar -> assertThat(licenses).containsPattern("\\b" + jar.replaceFirst("-\\d.*", "") + "\\b"));
    }

    private List<String> jars() throws IOException {
        return names().stream()
                .filter(name -> name.startsWith(folder + "/lib/") && name.endsWith(".jar"))
                .map(name -> name.substring(name.lastIndexOf('/') + 1))
                .toList();
    }

    private List<String> names() throws IOException {
        List<String> names = new ArrayList<>();
        try (ZipFile file = new ZipFile(zip.toFile())) {
            file.stream().map(ZipEntry::getName).forEach(names::add);
        }
        return names;
    }

    private byte[] read(String name) throws IOException {
        try (ZipFile file = new ZipFile(zip.toFile())) {
            return file.getInputStream(file.getEntry(folder + "/" + name)).readAllBytes();
        }
    }

    private static Path zip() {
        return ConnectRig.packagedPlugin();
    }
}
