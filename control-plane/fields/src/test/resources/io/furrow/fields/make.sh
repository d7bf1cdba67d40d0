#!/usr/bin/env bash
# Makes the files of fields that the importer's tests read, with GDAL 3.6 (Debian: gdal-bin); run it in this folder.
set -euo pipefail
export OGR_SQLITE_PRAGMA=page_size=512

# Two fields near Arganda (Spain): one with a hole, one of two parts. Positions are those of farm.geojson.
for code in 25830 3857 23030 3035; do
    ogr2ogr -q -f 'ESRI Shapefile' -t_srs EPSG:$code -lco ENCODING=UTF-8 "shapefile-$code.shp" farm.geojson
    ogr2ogr -q -f GPKG -lco SPATIAL_INDEX=NO -t_srs EPSG:$code -nln fields "geopackage-$code.gpkg" farm.geojson
    ogr2ogr -q -f GeoJSON -t_srs EPSG:$code -lco RFC7946=NO "geojson-$code.geojson" farm.geojson
done
ogr2ogr -q -f 'ESRI Shapefile' -t_srs EPSG:4326 -lco ENCODING=ISO-8859-1 shapefile-4326.shp farm.geojson
ogr2ogr -q -f GPKG -lco SPATIAL_INDEX=NO -t_srs EPSG:4326 -nln fields geopackage-4326.gpkg farm.geojson
ogr2ogr -q -f GPKG -lco SPATIAL_INDEX=NO -t_srs EPSG:4326 -nln fields geopackage-layers.gpkg farm.geojson
ogr2ogr -q -f GPKG -update -lco SPATIAL_INDEX=NO -t_srs EPSG:25830 -nln more geopackage-layers.gpkg farm.geojson
# Where UTM zone 31 belongs, and Finland, whose EPSG:2393 has its northing before its easting (as EPSG:3035 has).
ogr2ogr -q -f 'ESRI Shapefile' -t_srs EPSG:25831 shapefile-25831.shp farm-31.geojson
ogr2ogr -q -f GPKG -lco SPATIAL_INDEX=NO -t_srs EPSG:25831 -nln fields geopackage-25831.gpkg farm-31.geojson
ogr2ogr -q -f GPKG -lco SPATIAL_INDEX=NO -t_srs EPSG:2393 -nln fields geopackage-2393.gpkg farm-fi.geojson
ogr2ogr -q -f 'ESRI Shapefile' -t_srs EPSG:2393 shapefile-2393.shp farm-fi.geojson
ogr2ogr -q -f 'ESRI Shapefile' -dim XYZ -t_srs EPSG:25830 -zfield height shapefile-heights.shp farm.geojson
