import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.TreeSet;
import java.util.stream.Stream;
import javax.xml.parsers.DocumentBuilderFactory;
import org.w3c.dom.Element;
import org.w3c.dom.Node;

/**
 * Reads the reports of Surefire and Failsafe below a folder and prints a line for each test that failed ({@code FAIL}) and each that
 * passed when it was run again ({@code flaky:}). Ends with 1 if any failed or none ran.
 *
 * <p>Surefire calls a class red whose {@code @BeforeAll} failed once, though all its tests passed when they were run again; here it is
 * flaky: such a class has no second failure of its own.
 */
final class Results {
    private final TreeSet<String> failed = new TreeSet<>();
    private final TreeSet<String> flaky = new TreeSet<>();
    private int passed;

    public static void main(String[] arguments) throws Exception {
        Results results = new Results();
        List<Path> reports;
        try (Stream<Path> files = Files.walk(Path.of(arguments[0]), 5)) {
            reports = files.filter(file -> file.toString()
                            .matches(".*/target/(surefire|failsafe)-reports/TEST-[^/]*\\.xml"))
                    .sorted()
                    .toList();
        }
        for (Path report : reports) {
            results.read(report);
        }
        results.flaky.forEach(line -> System.out.println("flaky: " + line));
        results.failed.forEach(line -> System.out.println("FAIL " + line));
        System.out.printf("%d passed, %d failed%n", results.passed, results.failed.size());
        System.exit(results.failed.isEmpty() && results.passed > 0 ? 0 : 1);
    }

    private void read(Path report) throws Exception {
        Element suite;
        try {
            suite = DocumentBuilderFactory.newInstance()
                    .newDocumentBuilder()
                    .parse(report.toFile())
                    .getDocumentElement();
        } catch (IOException | org.xml.sax.SAXException e) {
            failed.add(report + ": the report is not complete: " + e.getMessage());
            return;
        }
        List<Element> tests = children(suite, "testcase");
        for (Element test : tests) {
            String name = test.getAttribute("classname") + "." + test.getAttribute("name");
            Element failure = first(test, "failure", "error");
            Element flake = first(test, "flakyFailure", "flakyError");
            if (failure != null && isOfClass(test) && first(test, "rerunFailure", "rerunError") == null && othersPassed(tests)) {
                flaky.add(name + " @BeforeAll: " + reason(failure));
            } else if (failure != null) {
                failed.add(name + ": " + reason(failure));
            } else if (first(test, "skipped") == null) {
                passed++;
                if (flake != null) {
                    flaky.add(name + ": " + reason(flake));
                }
            }
        }
    }

    private static boolean isOfClass(Element test) {
        return test.getAttribute("name").isEmpty();
    }

    private static boolean othersPassed(List<Element> tests) {
        return tests.size() > 1
                && tests.stream().filter(test -> !isOfClass(test)).allMatch(test -> first(test, "failure", "error") == null);
    }

    /** In one line. */
    private static String reason(Element failure) {
        String text = failure.getAttribute("type") + " " + failure.getAttribute("message");
        String line = text.replaceAll("\\s+", " ").strip();
        return line.length() <= 300 ? line : line.substring(0, 300) + "…";
    }

    private static Element first(Element test, String... names) {
        for (String name : names) {
            List<Element> found = children(test, name);
            if (!found.isEmpty()) {
                return found.get(0);
            }
        }
        return null;
    }

    private static List<Element> children(Element parent, String name) {
        List<Element> found = new ArrayList<>();
        for (Node child = parent.getFirstChild(); child != null; child = child.getNextSibling()) {
            if (child instanceof Element element && element.getTagName().equals(name)) {
                found.add(element);
            }
        }
        return found;
    }
}
