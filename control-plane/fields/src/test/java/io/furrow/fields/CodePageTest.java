package io.furrow.fields;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Arrays;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.field.FieldFile;

import static io.furrow.fields.FieldFilesTest.assertUnusable;
import static io.furrow.fields.FieldFilesTest.named;
import static io.furrow.fields.FieldFilesTest.resource;
import static org.assertj.core.api.Assertions.assertThat;

class CodePageTest {
    @TempDir
    private Path folder;

    /** The code page of the .cpg file, else of the table, as GDAL does; else the detected one. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', nullValues = "-", textBlock = """
        850          | 0   | IBM850       | Höhe | -
        CP850        | 0   | IBM850       | Höhe | -
        OEM 850      | 87  | IBM850       | Höhe | -
        cp437        | 0   | IBM437       | Höhe | -
        858          | 0   | IBM00858     | Höhe | -
        65001        | 0   | UTF-8        | Höhe | -
        UTF-8        | 0   | UTF-8        | Höhe | -
        ﻿UTF-8¶      | 0   | UTF-8        | Höhe | -
        utf8         | 87  | UTF-8        | Höhe | -
        ANSI 1252    | 0   | windows-1252 | Höhe | -
        1252         | 2   | windows-1252 | Höhe | -
        windows-1252 | 0   | windows-1252 | Höhe | -
        ANSI 1251    | 0   | windows-1251 | Поле | -
        1250         | 0   | windows-1250 | łąka | -
        866          | 0   | IBM866       | Поле | -
        ISO 8859-1   | 0   | ISO-8859-1   | Höhe | -
        ISO-8859-15  | 0   | ISO-8859-15  | Höhe | -
        8859-1       | 0   | ISO-8859-1   | Höhe | -
        88591        | 0   | ISO-8859-1   | Höhe | -
        885915       | 0   | ISO-8859-15  | Höhe | -
        28592        | 0   | ISO-8859-2   | łąka | -
        932          | 0   | windows-31j  | 畑    | -
        936          | 0   | GBK          | 田    | -
        Big5         | 0   | Big5         | 田    | -
        10000        | 0   | x-MacRoman   | Höhe | -
        -            | 2   | IBM850       | Höhe | -
        -            | 201 | windows-1251 | Поле | -
        -            | 87  | ISO-8859-1   | Höhe | -
        ¶            | 87  | ISO-8859-1   | Höhe | -
        -            | 0   | UTF-8        | Höhe | UTF-8
        -            | 87  | UTF-8        | Höhe | UTF-8
        -            | 0   | ISO-8859-1   | Höhe | ISO-8859-1
        -            | 0   | US-ASCII     | Hohe | -
        """)
    void readsTextsInTheNamedCodePage(String cpg, int driver, String charset, String name, String assumed)
            throws Exception {
        Path shp = Files.copy(resource("shapefile-25830.shp"), folder.resolve("coded.shp"));
        Files.copy(resource("shapefile-25830.prj"), folder.resolve("coded.prj"));
        byte[] table = Files.readAllBytes(resource("shapefile-25830.dbf"));
        table[29] = (byte) driver;
        for (int column : new int[] {386, 811}) { // 'name' of both rows
            Arrays.fill(table, column, column + 80, (byte) ' ');
            byte[] text = name.getBytes(charset);
            System.arraycopy(text, 0, table, column, text.length);
        }
        Files.write(folder.resolve("coded.dbf"), table);
        if (cpg != null) {
            Files.writeString(folder.resolve("coded.cpg"), cpg.replace('¶', '\n'));
        }

        FieldFile read = FieldFiles.read(shp, named("code"));

        assertThat(read.fields().get(0).version().name()).isEqualTo(name);
        if (assumed == null) {
            assertThat(read.notes()).isEmpty();
        } else {
            assertThat(read.notes())
                    .containsExactly("there is no .cpg file next to it: its texts were read as " + assumed);
        }
    }

    @Test
    void explainsHowToCorrectACpgFile() throws Exception {
        Path shp = Files.copy(resource("shapefile-25830.shp"), folder.resolve("coded.shp"));
        Files.copy(resource("shapefile-25830.dbf"), folder.resolve("coded.dbf"));
        Files.writeString(folder.resolve("coded.cpg"), "Klingon");

        assertUnusable(
                shp,
                named("code"),
                "names the unknown code page 'Klingon'; write the encoding of the .dbf file into it");
    }
}
