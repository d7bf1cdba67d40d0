package io.furrow.suite;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import com.tngtech.archunit.base.DescribedPredicate;
import com.tngtech.archunit.core.domain.JavaClass;
import com.tngtech.archunit.core.domain.JavaClasses;
import com.tngtech.archunit.core.importer.ClassFileImporter;
import com.tngtech.archunit.lang.ArchRule;
import com.tngtech.archunit.lang.syntax.ArchRuleDefinition;
import com.tngtech.archunit.library.dependencies.SlicesRuleDefinition;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import static com.tngtech.archunit.core.domain.JavaClass.Predicates.resideInAnyPackage;
import static com.tngtech.archunit.lang.syntax.ArchRuleDefinition.noClasses;
import static com.tngtech.archunit.lang.syntax.ArchRuleDefinition.noFields;
import static org.assertj.core.api.Assertions.assertThat;

class ArchitectureTest {
    private static final int MAX_CLASSES_OF_A_PACKAGE = 30;
    private static final JavaClasses CLASSES = everyModule();

    private static final Set<String> BANNED = Set.of("""
                    board caretaker charge commission desk doubt fate follower gatekeeper glimpse keeper lane meeting
                    outbox patience reception refeed roster shelf sighting timetable wish""".split("\\s+"));

    /** Four layers: the kit, independent modules, the suite that combines them, benchmarks. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
                    io.furrow.model      |
                    io.furrow.http       |
                    io.furrow.kafka      | model
                    io.furrow.flink      | model, kafka
                    io.furrow.mission    | model
                    io.furrow.connect    | model, http
                    io.furrow.ingest     | model, flink, mission
                    io.furrow.analytics  | model, flink
                    io.furrow.replay     | model, kafka, flink, mission
                    io.furrow.control    | model, http, kafka, mission
                    io.furrow.provisioner | model, kafka
                    io.furrow.fields     | model
                    io.furrow.dashboard  | model, http, kafka
                    io.furrow.fiware     | model, http
                    io.furrow.simulators | model, kafka
                    io.furrow.embedded   | http
                    io.furrow.cli        | model, kafka, flink, mission, fields
                    io.furrow.launcher   | model, http, kafka, flink, mission, connect, ingest, analytics, replay, control, provisioner, fields, dashboard, fiware, simulators, embedded, cli
                    """)
    void modulesDependOnlyOnAllowedOnes(String module, String allowed) {
        List<String> others = allowed == null ? List.of() : List.of(allowed.split(", "));
        String[] mayUse = Stream.concat(Stream.of(module), others.stream().map("io.furrow."::concat))
                .map(name -> name + "..")
                .toArray(String[]::new);
        DescribedPredicate<JavaClass> ours = resideInAnyPackage("io.furrow..");

        noClasses()
                .that()
                .resideInAPackage(module + "..")
                .should()
                .dependOnClassesThat(ours.and(DescribedPredicate.not(resideInAnyPackage(mayUse))))
                .check(CLASSES);
    }

    /** Jobs share the fields, the clocks of devices, how entities are read, and event-time utilities. */
    @ParameterizedTest
    @ValueSource(strings = "io.furrow.analytics.(*)..")
    void jobsDoNotDependOnEachOther(String jobs) {
        SlicesRuleDefinition.slices()
                .matching(jobs)
                .should()
                .notDependOnEachOther()
                .ignoreDependency(
                        resideInAnyPackage("io.furrow.analytics.."),
                        resideInAnyPackage(
                                "io.furrow.analytics.clock",
                                "io.furrow.analytics.eventtime",
                                "io.furrow.analytics.field",
                                "io.furrow.analytics.job",
                                "io.furrow.analytics.position"))
                .check(CLASSES);
    }

    /** The job combines its branches, which depend on the events of {@code route} and not on each other. */
    @Test
    void branchesOfIngestDoNotDependOnEachOther() {
        SlicesRuleDefinition.slices()
                .matching("io.furrow.ingest.(*)..")
                .should()
                .notDependOnEachOther()
                .ignoreDependency(
                        resideInAnyPackage("io.furrow.ingest.."), resideInAnyPackage("io.furrow.ingest.route"))
                .check(CLASSES);
        noClasses()
                .that()
                .resideInAPackage("io.furrow.ingest.route")
                .should()
                .dependOnClassesThat(resideInAnyPackage("io.furrow.ingest..")
                        .and(DescribedPredicate.not(resideInAnyPackage("io.furrow.ingest.route"))))
                .check(CLASSES);
    }

    /** The timing of replays can be tested without a cluster. */
    @Test
    void rulesOfReplaysDoNotDependOnEngines() {
        noClasses()
                .that()
                .resideInAPackage("io.furrow.replay.playback")
                .should()
                .dependOnClassesThat()
                .resideInAnyPackage("org.apache..", "com.mongodb..", "io.furrow.replay.source")
                .check(CLASSES);
    }

    @Test
    void noPackageHasAMeaninglessName() {
        ArchRule rule = ArchRuleDefinition.noClasses()
                .should()
                .resideInAnyPackage(
                        "..common..", "..util..", "..utils..", "..core..", "..misc..", "..impl..", "..helper..");

        rule.check(CLASSES);
    }

    @Test
    void noPackageHasTooManyClasses() {
        Map<String, Long> crowded = CLASSES.stream()
                .filter(each -> each.isTopLevelClass() && !each.getSimpleName().equals("package-info"))
                .filter(each -> !each.getPackageName().endsWith(".jmh_generated"))
                .collect(Collectors.groupingBy(JavaClass::getPackageName, TreeMap::new, Collectors.counting()));
        crowded.values().removeIf(classes -> classes <= MAX_CLASSES_OF_A_PACKAGE);

        assertThat(crowded).isEmpty();
    }

    @Test
    void packagesHaveNoCycles() {
        SlicesRuleDefinition.slices()
                .matching("io.furrow.(**)")
                .should()
                .beFreeOfCycles()
                .check(CLASSES);
    }

    /** The list of words is in CONTRIBUTING.md. */
    @Test
    void classesAndConstantsUseTheWordsOfTheField() {
        noClasses()
                .should()
                .haveNameMatching(".*(Desk|Keeper|Gatekeeper|Caretaker|Book|Shelf|Board)s?")
                .check(CLASSES);
        noFields()
                .should()
                .haveNameMatching(
                        "(.*_)?(PATIENCE|LOOK|LOOKS)(_.*)?|(MOST|LONGEST|LEAST|SHORTEST|FEWEST)(_(?!SEVERE).*)?")
                .check(CLASSES);
    }

    @Test
    void identifiersUseTheWordsOfTheField() throws IOException {
        for (Path module : modules()) {
            assertThat(SourceWords.identifiersWith(BANNED, module))
                    .as("%s", module)
                    .isEmpty();
        }
    }

    @Test
    void modelDoesNotDependOnEngines() {
        noClasses()
                .that()
                .resideInAPackage("io.furrow.model..")
                .should()
                .dependOnClassesThat()
                .resideInAnyPackage("org.apache..", "org.eclipse..")
                .check(CLASSES);
    }

    /** Each adapter of the access rule is used without the engines of the others. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
                    io.furrow.http         | java.., io.furrow.http
                    io.furrow.http.jetty   | java.., io.furrow.http, io.furrow.http.jetty, org.eclipse.jetty..
                    io.furrow.http.flink   | java.., io.furrow.http, io.furrow.http.flink, org.apache.flink..
                    io.furrow.http.connect | java.., io.furrow.http, io.furrow.http.connect, org.apache.kafka.., jakarta..
                    io.furrow.http.prometheus | java.., io.furrow.http.prometheus, io.prometheus..
                    """)
    void accessRuleDoesNotDependOnEnginesNorItsAdaptersOnEachOther(String where, String allowed) {
        ArchRuleDefinition.classes()
                .that()
                .resideInAPackage(where)
                .should()
                .onlyDependOnClassesThat()
                .resideInAnyPackage(allowed.split(", "))
                .check(CLASSES);
    }

    @Test
    void importsEveryModule() {
        assertThat(CLASSES).extracting(JavaClass::getPackageName).contains("""
                                io.furrow.model.ngsi io.furrow.http io.furrow.embedded io.furrow.flink.job
                                io.furrow.mission io.furrow.connect.source io.furrow.ingest.route
                                io.furrow.analytics.collision io.furrow.replay.playback io.furrow.fields
                                io.furrow.fiware io.furrow.bench.load io.furrow.launcher""".split("\\s+"));
    }

    /** Imports class folders, because the connector is on no class path. */
    private static JavaClasses everyModule() {
        return new ClassFileImporter()
                .importPaths(modules().stream()
                        .map(module -> module.resolve("target/classes"))
                        .filter(Files::isDirectory)
                        .toList());
    }

    /** The parent folder contains the sources of the system tests. */
    private static List<Path> modules() {
        try (Stream<Path> folders = Files.walk(Path.of(".."), 2)) {
            return folders.filter(folder -> Files.exists(folder.resolve("pom.xml")))
                    .filter(folder -> Files.isDirectory(folder.resolve("src")))
                    .toList();
        } catch (IOException e) {
            throw new java.io.UncheckedIOException("cannot list the modules", e);
        }
    }
}
