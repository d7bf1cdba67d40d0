package io.furrow.analytics;

import java.lang.reflect.Field;
import java.lang.reflect.Modifier;
import java.net.URI;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.Map;

import org.junit.jupiter.api.Test;

import io.furrow.files.Folders;

import static org.assertj.core.api.Assertions.assertThat;

class StaticStateTest {
    /** More than any table of constants has. */
    private static final int FEW = 64;

    @Test
    void noClassHoldsSomethingForEver() throws Exception {
        List<String> held = new ArrayList<>();
        URI root = TestEnvironment.class
                .getClassLoader()
                .getResource("io/furrow/analytics/AnalyticsJobs.class")
                .toURI();
        Path classes = Path.of(root).getParent();
        for (Path file : Folders.walk(classes).stream()
                .filter(each -> each.toString().endsWith(".class"))
                .toList()) {
            String name = "io.furrow.analytics."
                    + classes.relativize(file).toString().replace('/', '.').replaceAll("[.]class$", "");
            for (Field field : Class.forName(name).getDeclaredFields()) {
                if (Modifier.isStatic(field.getModifiers()) && holdsMuch(field)) {
                    held.add(name + "." + field.getName());
                }
            }
        }
        assertThat(held).isEmpty();
    }

    private static boolean holdsMuch(Field field) throws IllegalAccessException {
        Class<?> type = field.getType();
        if (!type.isArray() && !Collection.class.isAssignableFrom(type) && !Map.class.isAssignableFrom(type)) {
            return false;
        }
        field.setAccessible(true);
        Object value = field.get(null);
        return value instanceof Object[] array && array.length > FEW
                || value instanceof Collection<?> all && all.size() > FEW
                || value instanceof Map<?, ?> map && (map.size() > FEW || !isConstant(map))
                || value instanceof Collection<?> list && !isConstant(list);
    }

    /** Those that the library makes unchangeable. */
    private static boolean isConstant(Object collection) {
        return collection.getClass().getName().startsWith("java.util.Immutable");
    }
}
