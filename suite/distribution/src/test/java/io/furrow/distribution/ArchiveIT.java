package io.furrow.distribution;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.MessageDigest;
import java.util.HexFormat;
import java.util.List;
import java.util.Set;
import java.util.regex.Pattern;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.files.Folders;
import io.furrow.process.TestProcess;
import io.furrow.process.TestProcess.Ended;

import static org.assertj.core.api.Assertions.assertThat;

/** What a user unpacks, run with nothing but a JDK. */
class ArchiveIT {
    private static final String VERSION = System.getProperty("furrow.version");
    private static final Path ARCHIVE = Path.of("target", "furrow-%s.tar.gz".formatted(VERSION));

    private static final Pattern LICENSED = Pattern.compile("\\([^():]+:([^:]+):(\\S+) - ");
    /** To files of the archive, but not into pages. */
    private static final Pattern LINK = Pattern.compile("]\\(((?!https?:)[^)#\\s]+)(?:#[^)]*)?\\)");

    private static final Pattern LISTED = Pattern.compile("\"pkg:maven/[^/]+/([^@]+)@([^?]+)\\?[^\"]*type=jar\"");

    @TempDir
    static Path directory;

    private static Path home;

    @BeforeAll
    static void unpack() throws Exception {
        assertThat(run("tar", "xzf", ARCHIVE.toString(), "-C", directory.toString())
                        .status())
                .isZero();
        home = directory.resolve("furrow-" + VERSION);
    }

    @Test
    void hasTheChecksumBesideIt() throws Exception {
        byte[] sum = MessageDigest.getInstance("SHA-256").digest(Files.readAllBytes(ARCHIVE));

        assertThat(Path.of(ARCHIVE + ".sha256"))
                .hasContent("%s  %s".formatted(HexFormat.of().formatHex(sum), ARCHIVE.getFileName()));
    }

    @Test
    void namesEachOfItsJarsOnceAndTheCopiesOfGeoToolsLast() throws IOException {
        List<String> named = Files.readAllLines(home.resolve("lib/class-path"));

        assertThat(named).containsExactlyInAnyOrderElementsOf(jars("lib")).doesNotHaveDuplicates();
        assertThat(named.get(0)).startsWith("furrow-launcher-");
        assertThat(named.get(named.size() - 1)).startsWith("geotools-wrapper-");
    }

    @Test
    void listsWhatOthersMadeWithItsLicense() throws IOException {
        String licenses = Files.readString(home.resolve("THIRD-PARTY.txt"));
        String components = Files.readString(home.resolve("sbom.cdx.json"));

        Set<String> licensed = artifacts(LICENSED, licenses);
        Set<String> listed = artifacts(LISTED, components);
        assertThat(jars("lib").stream()
                        .filter(jar -> !jar.startsWith("furrow-"))
                        .map(jar -> jar.replace("-linux-x86_64.jar", ".jar")))
                .allSatisfy(jar -> {
                    assertThat(licensed).contains(jar);
                    assertThat(listed).contains(jar);
                });
        assertThat(licenses).doesNotContain("Unknown license");
        assertThat(home.resolve("LICENSE")).content().contains("Apache License");
    }

    @Test
    void reportsItsVersionAndItsCommands() throws Exception {
        assertThat(furrow("--version")).isEqualTo(new Ended(0, "furrow %s\n".formatted(VERSION)));
        assertThat(furrow("--help").output()).contains("demo", "mission", "init");
        assertThat(jars("lib", ".jsa")).as("stored classes").hasSize(1);
        assertThat(furrow("mission", "list", "--api", "http://127.0.0.1:1")).satisfies(ended -> {
            assertThat(ended.status()).isNotZero();
            assertThat(ended.output()).contains("127.0.0.1:1").hasLineCount(1);
        });
    }

    @Test
    void completesCommandsInBash() throws Exception {
        assertThat(run("bash", "-c", "source '%s/completions/furrow.bash' && complete -p furrow".formatted(home)))
                .satisfies(ended -> assertThat(ended.status()).isZero());
    }

    @Test
    void bringsTheConnectorAndTheFilesForContainers() {
        assertThat(home.resolve("plugins/furrow-ngsi-connector-%s/lib/furrow-ngsi-connector-%s.jar"
                        .formatted(VERSION, VERSION)))
                .exists();
        assertThat(home.resolve("docker/compose.yaml")).exists();
        assertThat(home.resolve("docker/mosquitto/run")).isExecutable();
        assertThat(home.resolve("docker/flink/submit")).isExecutable();
        assertThat(home.resolve("systemd/furrow.service")).exists();
        assertThat(home.resolve("examples/fields.geojson")).content().contains("\"field-1\"");
    }

    @Test
    void hasWhatItsPagesLeadTo() throws IOException {
        List<Path> pages = Folders.walk(home).stream()
                .filter(file -> file.toString().endsWith(".md") && !file.startsWith(home.resolve("plugins")))
                .toList();
        assertThat(pages).hasSizeGreaterThan(50);
        for (Path page : pages) {
            assertThat(LINK.matcher(Files.readString(page)).results().map(found -> found.group(1)))
                    .as(page.toString())
                    .filteredOn(link -> !link.contains("src/"))
                    .allSatisfy(link -> assertThat(page.resolveSibling(link)).exists());
        }
    }

    @ParameterizedTest
    @CsvSource({
        "ingest, ingest",
        "ingest, normalize",
        "analytics, temperature",
        "analytics, collision",
        "analytics, presence",
        "analytics, coverage",
        "replay, replay"
    })
    void rejectsWrongOptionsOfAJobInASentence(String module, String job) throws Exception {
        String jar = home.resolve("jobs/furrow-%s-%s-job.jar".formatted(module, VERSION))
                .toString();

        assertThat(java("-jar", jar, job, "--help").output()).contains("--bootstrap-servers");
        Ended refused = java("-jar", jar, job, "--bootstrap-server", "kafka:9092");
        assertThat(refused.status()).isNotZero();
        assertThat(refused.output())
                .contains("option", "See: furrow-", "--help")
                .doesNotContain("\tat ");
    }

    /** As names of jars. */
    private static Set<String> artifacts(Pattern pattern, String text) {
        return pattern.matcher(text)
                .results()
                .map(found -> "%s-%s.jar".formatted(found.group(1), found.group(2)))
                .collect(Collectors.toSet());
    }

    private static Set<String> jars(String folder) throws IOException {
        return jars(folder, ".jar");
    }

    private static Set<String> jars(String folder, String ending) throws IOException {
        return Folders.list(home.resolve(folder)).stream()
                .map(file -> file.getFileName().toString())
                .filter(name -> name.endsWith(ending))
                .collect(Collectors.toSet());
    }

    private static Ended furrow(String... words) throws Exception {
        return run(Stream.concat(Stream.of(home.resolve("bin/furrow").toString()), Stream.of(words))
                .toArray(String[]::new));
    }

    private static Ended java(String... words) throws Exception {
        return run(Stream.concat(Stream.of(TestProcess.program("java")), Stream.of(words))
                .toArray(String[]::new));
    }

    private static Ended run(String... words) throws Exception {
        ProcessBuilder builder = new ProcessBuilder(words);
        builder.environment().put("JAVA_HOME", System.getProperty("java.home"));
        return TestProcess.run(builder);
    }
}
