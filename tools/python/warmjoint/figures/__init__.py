"""Every figure and page of warmjoint, by matplotlib and Jinja2: numbers of C++ (tools/shown) and of a run's database to pictures.

style.py says how all look, sheet.py draws and remembers series, families.py lists all figures; a figure is one function of a view. The folder
is also the program that `warmjoint plot` and `report` call (__main__.py).
"""
