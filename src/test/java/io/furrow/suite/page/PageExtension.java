package io.furrow.suite.page;

import java.nio.file.Path;

import org.junit.jupiter.api.extension.AfterTestExecutionCallback;
import org.junit.jupiter.api.extension.ExtensionContext;
import org.junit.jupiter.api.extension.ExtensionContext.Namespace;
import org.junit.jupiter.api.extension.ParameterContext;
import org.junit.jupiter.api.extension.ParameterResolver;

import static org.assertj.core.api.Assertions.assertThat;

/**
 * Provides tests with the one {@link PageSuite}, started for the first and stopped after the last, or with a new {@link
 * FarmPage}. A test fails if one of its windows had an error on the console, an uncaught exception, or a violation of
 * the content security policy. Screenshots of the windows of failed tests are in {@code target/page}.
 */
final class PageExtension implements ParameterResolver, AfterTestExecutionCallback {
    private static final Namespace NAMESPACE = Namespace.create(PageExtension.class);
    private static final Path FAILED = Path.of("target", "page");

    @Override
    public boolean supportsParameter(ParameterContext parameter, ExtensionContext context) {
        Class<?> type = parameter.getParameter().getType();
        return type == PageSuite.class || type == FarmPage.class;
    }

    @Override
    public Object resolveParameter(ParameterContext parameter, ExtensionContext context) {
        boolean isPage = parameter.getParameter().getType() == FarmPage.class;
        return isPage ? suite(context).open("") : suite(context);
    }

    private static PageSuite suite(ExtensionContext context) {
        return context.getRoot()
                .getStore(NAMESPACE)
                .getOrComputeIfAbsent(
                        "suite",
                        key -> {
                            try {
                                return new SharedSuite(PageSuite.start());
                            } catch (Exception e) {
                                throw new IllegalStateException("The suite for the tests of the page did not start", e);
                            }
                        },
                        SharedSuite.class)
                .suite();
    }

    private record SharedSuite(PageSuite suite) implements AutoCloseable {
        @Override
        public void close() {
            suite.close();
        }
    }

    @Override
    public void afterTestExecution(ExtensionContext context) {
        PageSuite suite = suite(context);
        try {
            if (context.getExecutionException().isPresent()) {
                String name = context.getRequiredTestClass().getSimpleName() + "."
                        + context.getRequiredTestMethod().getName();
                for (int i = 0; i < suite.pages().size(); i++) {
                    suite.pages().get(i).screenshot(FAILED.resolve(name + "-" + i + ".png"));
                }
                return;
            }
            assertThat(suite.pages())
                    .allSatisfy(page ->
                            assertThat(page.errors()).as("errors of the window").isEmpty());
        } finally {
            suite.closePages();
        }
    }
}
