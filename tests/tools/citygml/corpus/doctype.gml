<?xml version="1.0"?><!DOCTYPE a [<!ENTITY e SYSTEM "file:///nowhere">]><CityModel xmlns="http://www.opengis.net/citygml/2.0" xmlns:b="http://www.opengis.net/citygml/building/2.0" xmlns:g="http://www.opengis.net/gml" xmlns:x="http://www.w3.org/1999/xlink" xmlns:d="dem" xmlns:f="frn" xmlns:a="app" xmlns:t="tran">

</CityModel>
